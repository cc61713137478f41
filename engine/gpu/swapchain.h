// Images of a window, acquired and presented with one semaphore pair a frame in flight.
#pragma once

#include "engine/gpu/functions.h"

#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace ag::gpu {

class Device;

struct SwapchainImage {
    uint32_t index = 0;
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkSemaphore acquired = VK_NULL_HANDLE;  // wait for it before writing the image
    VkSemaphore rendered = VK_NULL_HANDLE;  // signal it when done
};

// Of those that the surface offers; FIFO, which every surface has, waits for the screen, and so does a
// mailbox, which shows the newest image.
VkPresentModeKHR presentModeFor(bool vsync, std::span<const VkPresentModeKHR> offered);

class Swapchain {
  public:
    Swapchain(Device& device, glm::uvec2 size);
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    // Nothing while the window has no area; makes the images anew when the window changed.
    std::optional<SwapchainImage> acquire(glm::uvec2 windowSize);
    void present(const SwapchainImage& image);
    // Off: images are shown at once, torn if need be, where the surface can. The next ones are made so.
    void setVsync(bool on);

    VkFormat format() const { return format_; }
    glm::uvec2 size() const { return size_; }

  private:
    VkResult tryAcquire(VkSemaphore acquired, uint32_t& index);
    void renewSurface();
    void create(glm::uvec2 size);
    void destroyImages();

    Device& device_;
    VkSwapchainKHR handle_ = VK_NULL_HANDLE;
    VkFormat format_ = VK_FORMAT_B8G8R8A8_UNORM;
    VkColorSpaceKHR colorSpace_ = VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
    std::vector<VkPresentModeKHR> modes_;  // of the surface
    VkPresentModeKHR presentMode_ = VK_PRESENT_MODE_FIFO_KHR;
    glm::uvec2 size_{0};
    glm::uvec2 requested_{0};  // the window's size when the images were made
    bool stale_ = false;       // the surface said it no longer fits
    std::vector<VkImage> images_;
    std::vector<VkImageView> views_;
    std::vector<VkSemaphore> rendered_;  // one an image: free again when the image is acquired again
    std::vector<VkSemaphore> acquired_;  // one more than images, in turn
    size_t nextAcquire_ = 0;
};

}  // namespace ag::gpu
