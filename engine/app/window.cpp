#include "engine/app/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

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

}  // namespace

Result<std::unique_ptr<Window>> Window::open(const std::string& title, glm::uvec2 size) {
    if (!glfwInit()) return Error{"no window can be opened: " + lastError()};
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    std::unique_ptr<Window> window(new Window);
    window->window_ = glfwCreateWindow(int(size.x), int(size.y), title.c_str(), nullptr, nullptr);
    if (!window->window_) return Error{"no window can be opened: " + lastError()};
    glfwSetWindowUserPointer(window->window_, window.get());
    window->installCallbacks();
    return window;
}

void Window::installCallbacks() {
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int, int action, int) {
        if (action == GLFW_PRESS) self(w).pressed_.push_back(key);
    });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
        Window& window = self(w);
        if (window.captured_)
            window.moved_ += glm::vec2(float(x - window.cursor_.x), float(y - window.cursor_.y));
        window.cursor_ = {x, y};
    });
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

void Window::poll() {
    glfwPollEvents();
}

Input Window::takeInput() {
    Input input;
    const auto held = [&](int key) { return glfwGetKey(window_, key) == GLFW_PRESS ? 1.0f : 0.0f; };
    if (captured_) {
        input.forward = held(GLFW_KEY_W) - held(GLFW_KEY_S);
        input.right = held(GLFW_KEY_D) - held(GLFW_KEY_A);
        input.look = moved_;
        input.lampFree = glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
    }
    moved_ = {};
    return input;
}

std::vector<int> Window::takePressedKeys() {
    return std::exchange(pressed_, {});
}

void Window::captureCursor(bool captured) {
    captured_ = captured;
    glfwSetInputMode(window_, GLFW_CURSOR, captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
    if (glfwRawMouseMotionSupported()) glfwSetInputMode(window_, GLFW_RAW_MOUSE_MOTION, captured);
    glfwGetCursorPos(window_, &cursor_.x, &cursor_.y);  // movement counts from here
}

}  // namespace ag
