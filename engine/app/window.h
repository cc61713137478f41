// A GLFW window with its swapchain: events in, images out.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/app/input.h"
#include "engine/gpu/device.h"
#include "engine/gpu/swapchain.h"

struct GLFWwindow;

namespace ag {

class Window {
  public:
    // Fails with a sentence when there is no display.
    static Result<std::unique_ptr<Window>> open(const std::string& title, glm::uvec2 size);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    GLFWwindow* handle() const { return window_; }
    bool wantsToClose() const;
    void close();
    glm::uvec2 framebufferSize() const;

    void poll();
    // Movement keys held and mouse movement since the last call. Nothing while the cursor is free.
    Input takeInput();
    // Keys pressed since the last call, as GLFW numbers.
    std::vector<int> takePressedKeys();
    void captureCursor(bool captured);
    bool cursorCaptured() const { return captured_; }

  private:
    Window() = default;
    void installCallbacks();

    GLFWwindow* window_ = nullptr;
    bool captured_ = false;
    glm::dvec2 cursor_{0};
    glm::vec2 moved_{0};
    std::vector<int> pressed_;
};

}  // namespace ag
