#include "engine/app/window.h"

// GLFW declares its Vulkan functions after these.
#include "engine/gpu/functions.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

namespace ag {
namespace {

Window& self(GLFWwindow* window) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(window));
}

std::string lastError() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "unknown reason";
}

// The key that a gamepad's button stands for in menus.
int menuKeyOf(int padCode) {
    static constexpr std::pair<int, int> kKeys[] = {
        {GLFW_GAMEPAD_BUTTON_START, GLFW_KEY_ESCAPE},     {GLFW_GAMEPAD_BUTTON_DPAD_UP, GLFW_KEY_UP},
        {GLFW_GAMEPAD_BUTTON_DPAD_DOWN, GLFW_KEY_DOWN},   {GLFW_GAMEPAD_BUTTON_DPAD_LEFT, GLFW_KEY_LEFT},
        {GLFW_GAMEPAD_BUTTON_DPAD_RIGHT, GLFW_KEY_RIGHT}, {GLFW_GAMEPAD_BUTTON_A, GLFW_KEY_ENTER}};
    for (const auto& [button, key] : kKeys)
        if (padCode == kPadCode + button) return key;
    return 0;
}

uint32_t buttonOf(Action action) {
    switch (action) {
        case Action::kLamp:
            return kButtonLamp;
        case Action::kJump:
            return kButtonJump;
        case Action::kCrouch:
            return kButtonCrouch;
        default:
            return kButtonUse;
    }
}

float stick(float value) {
    constexpr float kDeadZone = 0.18f;
    return std::abs(value) < kDeadZone ? 0 : value;
}

// That which holds the middle of a window (its place and size); else the first one. Null: there is none.
GLFWmonitor* monitorOf(glm::ivec4 window) {
    const glm::ivec2 middle(window.x + window.z / 2, window.y + window.w / 2);
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    for (int i = 0; i < count; ++i) {
        glm::ivec2 at;
        glfwGetMonitorPos(monitors[i], &at.x, &at.y);
        const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
        if (!mode) continue;
        const glm::ivec2 inside = middle - at;
        if (inside.x >= 0 && inside.y >= 0 && inside.x < mode->width && inside.y < mode->height)
            return monitors[i];
    }
    return count > 0 ? monitors[0] : nullptr;
}

constexpr float kPressed = 0.3f;  // of a trigger, from -1 to 1
constexpr int kPadButtons = GLFW_GAMEPAD_BUTTON_LAST + 1;

// A bit a button, then one for each trigger.
uint32_t heldOn(const GLFWgamepadstate& pad) {
    uint32_t held = 0;
    for (int i = 0; i < kPadButtons; ++i)
        held |= uint32_t(pad.buttons[i] != 0) << i;
    held |= uint32_t(pad.axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER] > kPressed) << kPadButtons;
    held |= uint32_t(pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER] > kPressed) << (kPadButtons + 1);
    return held;
}
int bitOf(int padCode) {
    return padCode >= kPadTriggerCode ? kPadButtons + padCode - kPadTriggerCode : padCode - kPadCode;
}

// The first gamepad, if it is one of those GLFW knows.
void addPad(Input& input, const Bindings& bindings, double seconds) {
    constexpr float kLookSpeed = 750;  // pixels a second at full tilt
    GLFWgamepadstate pad;
    if (!glfwGetGamepadState(GLFW_JOYSTICK_1, &pad)) return;
    input.forward = std::clamp(input.forward - stick(pad.axes[GLFW_GAMEPAD_AXIS_LEFT_Y]), -1.0f, 1.0f);
    input.right = std::clamp(input.right + stick(pad.axes[GLFW_GAMEPAD_AXIS_LEFT_X]), -1.0f, 1.0f);
    input.look +=
        glm::vec2(stick(pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_X]), stick(pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_Y])) *
        (kLookSpeed * float(seconds));
    const uint32_t held = heldOn(pad);
    for (size_t i = 0; i < kPadActionCount; ++i)
        if (held >> bitOf(bindings.pad[i]) & 1)
            input.buttons |= buttonOf(Action(size_t(kFirstPadAction) + i));
}

}  // namespace

Result<std::unique_ptr<Window>> Window::open(const std::string& title, glm::uvec2 size) {
    if (!glfwInit()) return Error{"no window can be opened: " + lastError()};
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    std::unique_ptr<Window> window(new Window);
    window->window_ = glfwCreateWindow(int(size.x), int(size.y), title.c_str(), nullptr, nullptr);
    if (!window->window_) return Error{"no window can be opened: " + lastError()};
    // A tap shorter than a frame counts all the same.
    glfwSetInputMode(window->window_, GLFW_STICKY_KEYS, GLFW_TRUE);
    glfwSetInputMode(window->window_, GLFW_STICKY_MOUSE_BUTTONS, GLFW_TRUE);
    glfwSetWindowUserPointer(window->window_, window.get());
    window->installCallbacks();
    return window;
}

void Window::installCallbacks() {
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int, int action, int held) {
        if (action == GLFW_PRESS) self(w).events_.key({key, (held & GLFW_MOD_CONTROL) != 0});
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int) {
        self(w).events_.button(button, action == GLFW_PRESS);
    });
    glfwSetWindowFocusCallback(window_, [](GLFWwindow* w, int focused) {
        if (!focused) self(w).focusLost_ = true;
    });
    glfwGetCursorPos(window_, &cursor_.x, &cursor_.y);
    events_.move(cursor_);
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
        Window& window = self(w);
        if (window.captured_)
            window.moved_ += glm::vec2(float(x - window.cursor_.x), float(y - window.cursor_.y));
        window.cursor_ = {x, y};
        window.events_.move(window.cursor_);
    });
}

Result<gpu::WindowSurface> Window::surface() const {
    uint32_t count = 0;
    const char** extensions = glfwGetRequiredInstanceExtensions(&count);
    if (!extensions) return Error{"the window system has no Vulkan surface support"};
    return gpu::WindowSurface{{extensions, extensions + count},
                              [window = window_](VkInstance instance, VkSurfaceKHR* surface) {
                                  return glfwCreateWindowSurface(instance, window, nullptr, surface);
                              }};
}

Window::~Window() {
    if (window_) glfwDestroyWindow(window_);
    glfwTerminate();
}

bool Window::wantsToClose() const {
    return glfwWindowShouldClose(window_);
}
void Window::close() {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

glm::uvec2 Window::framebufferSize() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return {width, height};
}

void Window::setFullscreen(bool fullscreen) {
    if (fullscreen == fullscreen_) return;
    if (!fullscreen) {
        fullscreen_ = false;
        return glfwSetWindowMonitor(window_, nullptr, windowed_.x, windowed_.y, windowed_.z, windowed_.w,
                                    GLFW_DONT_CARE);
    }
    glfwGetWindowPos(window_, &windowed_.x, &windowed_.y);
    glfwGetWindowSize(window_, &windowed_.z, &windowed_.w);
    GLFWmonitor* monitor = monitorOf(windowed_);
    const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    if (!mode) return;
    glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
    fullscreen_ = true;
}

void Window::poll() {
    glfwPollEvents();
    notePadPresses();
    events_.beginFrame();
}

Input Window::takeInput(const Bindings& bindings, double seconds) {
    Input input;
    const auto held = [&](Action action) {
        const int code = bindings.codes[size_t(action)];
        return (code >= kMouseCode ? glfwGetMouseButton(window_, code - kMouseCode)
                                   : glfwGetKey(window_, code)) == GLFW_PRESS;
    };
    if (captured_) {
        input.forward = float(held(Action::kForward)) - float(held(Action::kBack));
        input.right = float(held(Action::kRight)) - float(held(Action::kLeft));
        input.look = moved_;
        for (const Action action : {Action::kLamp, Action::kJump, Action::kCrouch, Action::kUse})
            if (held(action)) input.buttons |= buttonOf(action);
        addPad(input, bindings, seconds);
    }
    moved_ = {};
    return input;
}

void Window::notePadPresses() {
    GLFWgamepadstate pad;
    const uint32_t now = glfwGetGamepadState(GLFW_JOYSTICK_1, &pad) ? heldOn(pad) : 0;
    for (int i = 0; i < kPadButtons + 2; ++i) {
        const int code = i < kPadButtons ? kPadCode + i : kPadTriggerCode + i - kPadButtons;
        if ((now & ~padBefore_) >> i & 1) events_.key({.code = menuKeyOf(code), .pad = code});
    }
    padBefore_ = now;
}

void Window::captureCursor(bool captured) {
    captured_ = captured;
    glfwSetInputMode(window_, GLFW_CURSOR, captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
    if (glfwRawMouseMotionSupported()) glfwSetInputMode(window_, GLFW_RAW_MOUSE_MOTION, captured);
    glfwGetCursorPos(window_, &cursor_.x, &cursor_.y);  // movement counts from here
    events_.move(cursor_);
}

}  // namespace ag
