#include "engine/core/spread_sets.h"

#include <algorithm>
#include <string_view>

namespace ag {
namespace {

// group.name=value
bool isAssignment(std::string_view text) {
    const auto isName = [](std::string_view name) {
        return !name.empty() && std::ranges::all_of(name, [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
        });
    };
    const size_t equals = text.find('='), dot = text.find('.');
    return equals != std::string_view::npos && dot < equals && isName(text.substr(0, dot)) &&
           isName(text.substr(dot + 1, equals - dot - 1));
}

}  // namespace

std::vector<std::string> reversedArguments(std::span<char* const> argv) {
    std::vector<std::string> out;
    bool afterSet = false;  // assignments follow
    for (const std::string text : argv.subspan(std::min<size_t>(argv.size(), 1))) {
        const bool assignment = isAssignment(text);
        if (assignment && afterSet && out.back() != "--set") out.emplace_back("--set");
        afterSet = text == "--set" || text.starts_with("--set=") || (assignment && afterSet);
        out.push_back(text);
    }
    std::ranges::reverse(out);
    return out;
}

}  // namespace ag
