#include "engine/app/bindings.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "engine/core/safe_file.h"

namespace ag {
namespace {

constexpr std::array<std::string_view, kActionCount> kActions = {"forward", "back",   "left", "right",
                                                                 "jump",    "crouch", "use",  "lamp"};

struct Named {
    const char* name;
    int code;
};
constexpr Named kNamed[] = {{"Space", GLFW_KEY_SPACE},
                            {"Tab", GLFW_KEY_TAB},
                            {"Enter", GLFW_KEY_ENTER},
                            {"Up", GLFW_KEY_UP},
                            {"Down", GLFW_KEY_DOWN},
                            {"Left", GLFW_KEY_LEFT},
                            {"Right", GLFW_KEY_RIGHT},
                            {"LeftShift", GLFW_KEY_LEFT_SHIFT},
                            {"RightShift", GLFW_KEY_RIGHT_SHIFT},
                            {"LeftControl", GLFW_KEY_LEFT_CONTROL},
                            {"RightControl", GLFW_KEY_RIGHT_CONTROL},
                            {"LeftAlt", GLFW_KEY_LEFT_ALT},
                            {"Comma", GLFW_KEY_COMMA},
                            {"Period", GLFW_KEY_PERIOD},
                            {"MouseLeft", kMouseCode + GLFW_MOUSE_BUTTON_LEFT},
                            {"MouseRight", kMouseCode + GLFW_MOUSE_BUTTON_RIGHT},
                            {"MouseMiddle", kMouseCode + GLFW_MOUSE_BUTTON_MIDDLE}};

}  // namespace

Bindings::Bindings()
    : codes{GLFW_KEY_W,     GLFW_KEY_S,          GLFW_KEY_A, GLFW_KEY_D,
            GLFW_KEY_SPACE, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_E, kMouseCode + GLFW_MOUSE_BUTTON_LEFT} {}

std::string_view actionName(Action action) {
    return kActions[size_t(action)];
}

std::string codeName(int code) {
    const bool letter = code >= GLFW_KEY_A && code <= GLFW_KEY_Z,
               digit = code >= GLFW_KEY_0 && code <= GLFW_KEY_9;
    if (letter || digit) return std::string(1, char(code));
    const auto found = std::ranges::find(kNamed, code, &Named::code);
    return found == std::end(kNamed) ? "" : found->name;
}

std::string spokenName(int code) {
    std::string spoken;
    for (const char c : codeName(code)) {
        const bool capital = c >= 'A' && c <= 'Z';
        if (capital && !spoken.empty()) spoken += ' ';
        spoken += c;
    }
    return spoken;
}

int codeFromName(std::string_view name) {
    if (name.size() == 1 && ((name[0] >= 'A' && name[0] <= 'Z') || (name[0] >= '0' && name[0] <= '9')))
        return name[0];
    for (const Named& named : kNamed)
        if (name == named.name) return named.code;
    return 0;
}

Result<Bindings> parseBindings(const std::string& text, const std::string& path) {
    Bindings bindings;
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        if (line.empty() || line[0] == '#') continue;
        std::istringstream words(line);
        std::string action, key, more;
        words >> action >> key;
        const auto found = std::ranges::find(kActions, std::string_view(action));
        if (found == kActions.end())
            return Error{fmt::format("{}: line {}: there is no action '{}'", path, number, action)};
        const int code = codeFromName(key);
        if (code == 0 || words >> more)
            return Error{
                fmt::format("{}: line {}: '{}' is not a key", path, number, line.substr(action.size()))};
        bindings.codes[size_t(found - kActions.begin())] = code;
    }
    return bindings;
}

Result<Bindings> loadBindings(const std::string& path) {
    const auto text = readFile(path);
    if (!text) return text.error();
    return parseBindings(*text, path);
}

Status saveBindings(const Bindings& bindings, const std::string& path) {
    std::string text = "# action key; a key is A-Z, 0-9 or one of:";
    for (const Named& named : kNamed)
        text += fmt::format(" {}", named.name);
    text += '\n';
    for (size_t i = 0; i < kActionCount; ++i)
        text += fmt::format("{} {}\n", kActions[i], codeName(bindings.codes[i]));
    return writeFileSafely(path, text);
}

}  // namespace ag
