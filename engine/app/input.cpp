#include "engine/app/input.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace ag {
namespace {

constexpr const char* kHeader = "afterglow replay 1";
constexpr size_t kMostTicks = 10'000'000;

}  // namespace

Status saveReplay(const std::vector<Input>& ticks, const std::string& path) {
    const std::string temporary = path + ".part";
    {
        std::ofstream out(temporary);
        out << kHeader << '\n';
        for (const Input& i : ticks)
            out << fmt::format("{} {} {} {} {}\n", i.forward, i.right, i.look.x, i.look.y, i.lampFree);
        out.flush();
        if (!out) return Error{path + ": the replay cannot be written"};
    }
    std::error_code error;
    std::filesystem::rename(temporary, path, error);
    if (error) return Error{fmt::format("{}: {}", path, error.message())};
    return Ok{};
}

Result<std::vector<Input>> loadReplay(const std::string& path) {
    std::ifstream in(path);
    if (!in) return Error{path + ": the replay cannot be opened"};
    std::string line;
    if (!std::getline(in, line) || line != kHeader)
        return Error{path + ": it is not a replay of this version"};
    std::vector<Input> ticks;
    Input i;
    while (in >> i.forward >> i.right >> i.look.x >> i.look.y >> i.lampFree) {
        const bool sane = std::abs(i.forward) <= 1 && std::abs(i.right) <= 1 && std::abs(i.look.x) < 1e5f &&
                          std::abs(i.look.y) < 1e5f && i.lampFree <= 1;
        if (!sane) return Error{fmt::format("{}: tick {} is out of range", path, ticks.size())};
        ticks.push_back(i);
        if (ticks.size() > kMostTicks) return Error{path + ": the replay is longer than the limit"};
    }
    if (!in.eof()) return Error{fmt::format("{}: line {} is not a tick", path, ticks.size() + 2)};
    return ticks;
}

}  // namespace ag
