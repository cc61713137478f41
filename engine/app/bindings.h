// Which key does what, and which button of a gamepad, as a file of lines like "forward W" and "pad_jump
// PadA".
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "engine/core/result.h"

namespace ag {

enum class Action : uint32_t { kForward, kBack, kLeft, kRight, kJump, kCrouch, kUse, kLamp, kCount };
constexpr size_t kActionCount = size_t(Action::kCount);

// A gamepad has buttons for these; its sticks walk and look.
constexpr Action kFirstPadAction = Action::kJump;
constexpr size_t kPadActionCount = kActionCount - size_t(kFirstPadAction);

// GLFW's number of a key, or kMouseCode plus that of a mouse button.
constexpr int kMouseCode = 1000;
// kPadCode plus GLFW's number of a gamepad's button, or kPadTriggerCode plus 0 for its left trigger and 1 for
// its right one.
constexpr int kPadCode = 2000, kPadTriggerCode = kPadCode + 100;

struct Bindings {
    std::array<int, kActionCount> codes;
    std::array<int, kPadActionCount> pad;  // of kFirstPadAction and those after it
    Bindings();  // WASD, space, left shift, E, left mouse button; A, B, X and the left bumper
    bool operator==(const Bindings&) const = default;
};

std::string_view actionName(Action action);
std::string codeName(int code);    // "" for codes that cannot be bound
std::string spokenName(int code);  // codeName in words: "Left Shift"
// 0: there is no such key.
int codeFromName(std::string_view name);
int padCodeFromName(std::string_view name);

Result<Bindings> parseBindings(const std::string& text, const std::string& path);
Result<Bindings> loadBindings(const std::string& path);
Status saveBindings(const Bindings& bindings, const std::string& path);

}  // namespace ag
