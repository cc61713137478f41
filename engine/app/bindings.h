// Which key does what, as a file of lines like "forward W".
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "engine/core/result.h"

namespace ag {

enum class Action : uint32_t { kForward, kBack, kLeft, kRight, kJump, kCrouch, kUse, kLamp, kCount };
constexpr size_t kActionCount = size_t(Action::kCount);

// GLFW's number of a key, or kMouseCode plus that of a mouse button.
constexpr int kMouseCode = 1000;

struct Bindings {
    std::array<int, kActionCount> codes;
    Bindings();  // WASD, space, left shift, E, left mouse button
    bool operator==(const Bindings&) const = default;
};

std::string_view actionName(Action action);
std::string codeName(int code);    // "" for codes that cannot be bound
std::string spokenName(int code);  // codeName in words: "Left Shift"
// 0: there is no such key.
int codeFromName(std::string_view name);

Result<Bindings> parseBindings(const std::string& text, const std::string& path);
Result<Bindings> loadBindings(const std::string& path);
Status saveBindings(const Bindings& bindings, const std::string& path);

}  // namespace ag
