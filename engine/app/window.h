// A GLFW window with its swapchain: events in, images out.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "engine/app/bindings.h"
#include "engine/app/input.h"
#include "engine/app/input_events.h"
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
    // For the device that shall draw into it. Fails with a sentence where the window system has no Vulkan.
    Result<gpu::WindowSurface> surface() const;
    bool wantsToClose() const;
    void close();
    glm::uvec2 framebufferSize() const;
    // The whole of the monitor it is mostly on, or as it was before.
    void setFullscreen(bool fullscreen);

    // Events in; the frame that begins sees of them what InputEvents says.
    void poll();
    // What is held down and mouse movement since the last call, and the first gamepad; `seconds` since then
    // turn its stick into movement. Nothing while the cursor is free.
    Input takeInput(const Bindings& bindings, double seconds);
    // Keys, mouse and gamepad buttons pressed since the last call; a gamepad's start, cross and south buttons
    // count as escape, arrows and enter.
    std::vector<KeyPress> takePressedKeys() { return events_.takeKeys(); }
    const Pointer& pointer() const { return events_.pointer(); }
    // Whether the window was left for another since the last call.
    bool takeFocusLost() { return std::exchange(focusLost_, false); }
    void captureCursor(bool captured);
    bool cursorCaptured() const { return captured_; }

  private:
    Window() = default;
    void installCallbacks();
    void notePadPresses();

    GLFWwindow* window_ = nullptr;
    bool captured_ = false, fullscreen_ = false;
    glm::ivec4 windowed_{0};  // place and size before it filled the monitor
    glm::dvec2 cursor_{0};
    glm::vec2 moved_{0};
    InputEvents events_;
    bool focusLost_ = false;
    uint32_t padBefore_ = 0;  // bits of the gamepad's buttons and triggers at the last look
};

}  // namespace ag
