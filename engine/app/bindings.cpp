#include "engine/app/bindings.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <span>
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
// Start opens the menu.
constexpr Named kPadNamed[] = {{"PadA", kPadCode + GLFW_GAMEPAD_BUTTON_A},
                               {"PadB", kPadCode + GLFW_GAMEPAD_BUTTON_B},
                               {"PadX", kPadCode + GLFW_GAMEPAD_BUTTON_X},
                               {"PadY", kPadCode + GLFW_GAMEPAD_BUTTON_Y},
                               {"PadLeftBumper", kPadCode + GLFW_GAMEPAD_BUTTON_LEFT_BUMPER},
                               {"PadRightBumper", kPadCode + GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER},
                               {"PadLeftTrigger", kPadTriggerCode},
                               {"PadRightTrigger", kPadTriggerCode + 1},
                               {"PadLeftStick", kPadCode + GLFW_GAMEPAD_BUTTON_LEFT_THUMB},
                               {"PadRightStick", kPadCode + GLFW_GAMEPAD_BUTTON_RIGHT_THUMB},
                               {"PadBack", kPadCode + GLFW_GAMEPAD_BUTTON_BACK},
                               {"PadUp", kPadCode + GLFW_GAMEPAD_BUTTON_DPAD_UP},
                               {"PadDown", kPadCode + GLFW_GAMEPAD_BUTTON_DPAD_DOWN},
                               {"PadLeft", kPadCode + GLFW_GAMEPAD_BUTTON_DPAD_LEFT},
                               {"PadRight", kPadCode + GLFW_GAMEPAD_BUTTON_DPAD_RIGHT}};
constexpr std::string_view kPadPrefix = "pad_";

// "" and 0 for what is not in the table.
std::string nameIn(std::span<const Named> table, int code) {
    const auto found = std::ranges::find(table, code, &Named::code);
    return found == table.end() ? "" : found->name;
}
int codeIn(std::span<const Named> table, std::string_view name) {
    for (const Named& named : table)
        if (name == named.name) return named.code;
    return 0;
}

std::string listOf(std::span<const Named> table) {
    std::string text;
    for (const Named& named : table)
        text += fmt::format(" {}", named.name);
    return text;
}

struct Bound {  // what a word of the file names
    int* code = nullptr;
    bool pad = false;
};
Bound boundBy(Bindings& bindings, std::string_view word) {
    const bool pad = word.starts_with(kPadPrefix);
    if (pad) word.remove_prefix(kPadPrefix.size());
    const size_t action = size_t(std::ranges::find(kActions, word) - kActions.begin());
    const size_t first = pad ? size_t(kFirstPadAction) : 0;
    if (action == kActionCount || action < first) return {};
    return {pad ? &bindings.pad[action - first] : &bindings.codes[action], pad};
}

}  // namespace

Bindings::Bindings()
    : codes{GLFW_KEY_W,     GLFW_KEY_S,          GLFW_KEY_A, GLFW_KEY_D,
            GLFW_KEY_SPACE, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_E, kMouseCode + GLFW_MOUSE_BUTTON_LEFT},
      pad{kPadCode + GLFW_GAMEPAD_BUTTON_A, kPadCode + GLFW_GAMEPAD_BUTTON_B,
          kPadCode + GLFW_GAMEPAD_BUTTON_X, kPadCode + GLFW_GAMEPAD_BUTTON_LEFT_BUMPER} {}

std::string_view actionName(Action action) {
    return kActions[size_t(action)];
}

std::string codeName(int code) {
    const bool letter = code >= GLFW_KEY_A && code <= GLFW_KEY_Z,
               digit = code >= GLFW_KEY_0 && code <= GLFW_KEY_9;
    if (letter || digit) return std::string(1, char(code));
    return nameIn(code < kPadCode ? std::span<const Named>(kNamed) : std::span<const Named>(kPadNamed), code);
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
    return codeIn(kNamed, name);
}

int padCodeFromName(std::string_view name) {
    return codeIn(kPadNamed, name);
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
        const Bound bound = boundBy(bindings, action);
        if (!bound.code)
            return Error{fmt::format("{}: line {}: there is no action '{}'", path, number, action)};
        const int code = bound.pad ? padCodeFromName(key) : codeFromName(key);
        if (code == 0 || words >> more)
            return Error{fmt::format("{}: line {}: '{}' is not a {}", path, number,
                                     line.substr(action.size()), bound.pad ? "gamepad's button" : "key")};
        *bound.code = code;
    }
    return bindings;
}

Result<Bindings> loadBindings(const std::string& path) {
    const auto text = readFile(path);
    if (!text) return text.error();
    return parseBindings(*text, path);
}

Status saveBindings(const Bindings& bindings, const std::string& path) {
    std::string text = fmt::format("# action key; a key is A-Z, 0-9 or one of:{}\n", listOf(kNamed));
    for (size_t i = 0; i < kActionCount; ++i)
        text += fmt::format("{} {}\n", kActions[i], codeName(bindings.codes[i]));
    text += fmt::format("# action button; a gamepad's button is one of:{}\n", listOf(kPadNamed));
    for (size_t i = 0; i < kPadActionCount; ++i)
        text += fmt::format("{}{} {}\n", kPadPrefix, kActions[size_t(kFirstPadAction) + i],
                            codeName(bindings.pad[i]));
    return writeFileSafely(path, text);
}

}  // namespace ag
