#include "engine/gpu/swapchain.h"

#include <algorithm>

#include "engine/gpu/device.h"

namespace ag::gpu {
namespace {

VkSemaphore makeSemaphore(Device& device, const char* name) {
    const VkSemaphoreCreateInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    VkSemaphore semaphore = VK_NULL_HANDLE;
    AG_VK(device.vk().CreateSemaphore(device.handle(), &info, nullptr, &semaphore));
    device.context().setDebugName(VK_OBJECT_TYPE_SEMAPHORE, semaphore, name);
    return semaphore;
}

VkImageView makeView(Device& device, VkImage image, VkFormat format) {
    const VkImageViewCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                     .image = image,
                                     .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                     .format = format,
                                     .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
    VkImageView view = VK_NULL_HANDLE;
    AG_VK(device.vk().CreateImageView(device.handle(), &info, nullptr, &view));
    device.context().setDebugName(VK_OBJECT_TYPE_IMAGE, image, "swapchain.image");
    device.context().setDebugName(VK_OBJECT_TYPE_IMAGE_VIEW, view, "swapchain.image");
    return view;
}

}  // namespace

VkPresentModeKHR presentModeFor(bool vsync, std::span<const VkPresentModeKHR> offered) {
    const auto has = [&](VkPresentModeKHR mode) { return std::ranges::find(offered, mode) != offered.end(); };
    if (!vsync && has(VK_PRESENT_MODE_IMMEDIATE_KHR)) return VK_PRESENT_MODE_IMMEDIATE_KHR;
    return has(VK_PRESENT_MODE_MAILBOX_KHR) ? VK_PRESENT_MODE_MAILBOX_KHR : VK_PRESENT_MODE_FIFO_KHR;
}

Swapchain::Swapchain(Device& device, glm::uvec2 size) : device_(device) {
    uint32_t count = 0;
    device.vk().GetPhysicalDeviceSurfaceFormatsKHR(device.context().physical(), device.surface(), &count,
                                                   nullptr);
    std::vector<VkSurfaceFormatKHR> formats(count);
    device.vk().GetPhysicalDeviceSurfaceFormatsKHR(device.context().physical(), device.surface(), &count,
                                                   formats.data());
    // UNORM: the display image is sRGB-encoded already.
    const auto found = std::ranges::find_if(formats, [](const VkSurfaceFormatKHR& f) {
        return f.format == VK_FORMAT_B8G8R8A8_UNORM || f.format == VK_FORMAT_R8G8B8A8_UNORM;
    });
    if (found != formats.end()) {
        format_ = found->format;
        colorSpace_ = found->colorSpace;
    }
    device.vk().GetPhysicalDeviceSurfacePresentModesKHR(device.context().physical(), device.surface(), &count,
                                                        nullptr);
    modes_.resize(count);
    device.vk().GetPhysicalDeviceSurfacePresentModesKHR(device.context().physical(), device.surface(), &count,
                                                        modes_.data());
    presentMode_ = presentModeFor(true, modes_);
    create(size);
}

void Swapchain::setVsync(bool on) {
    const VkPresentModeKHR wanted = presentModeFor(on, modes_);
    stale_ |= wanted != presentMode_;
    presentMode_ = wanted;
}

Swapchain::~Swapchain() {
    device_.waitIdle();
    destroyImages();
    device_.vk().DestroySwapchainKHR(device_.handle(), handle_, nullptr);
}

void Swapchain::destroyImages() {
    for (VkSemaphore s : rendered_)
        device_.vk().DestroySemaphore(device_.handle(), s, nullptr);
    for (VkSemaphore s : acquired_)
        device_.vk().DestroySemaphore(device_.handle(), s, nullptr);
    for (VkImageView v : views_)
        device_.vk().DestroyImageView(device_.handle(), v, nullptr);
    views_.clear();
    rendered_.clear();
    acquired_.clear();
    images_.clear();
}

void Swapchain::create(glm::uvec2 wanted) {
    VkSurfaceCapabilitiesKHR caps;
    AG_VK(device_.vk().GetPhysicalDeviceSurfaceCapabilitiesKHR(device_.context().physical(),
                                                               device_.surface(), &caps));
    VkExtent2D extent = caps.currentExtent;
    if (extent.width == UINT32_MAX)
        extent = {std::clamp(wanted.x, caps.minImageExtent.width, caps.maxImageExtent.width),
                  std::clamp(wanted.y, caps.minImageExtent.height, caps.maxImageExtent.height)};
    requested_ = wanted;
    size_ = {extent.width, extent.height};
    stale_ = false;
    if (size_.x == 0 || size_.y == 0) return;  // minimised

    device_.waitIdle();
    destroyImages();
    const uint32_t most = caps.maxImageCount ? caps.maxImageCount : UINT32_MAX;
    const VkSwapchainCreateInfoKHR info{
        .sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
        .surface = device_.surface(),
        .minImageCount = std::min(std::max(caps.minImageCount, 3u), most),
        .imageFormat = format_,
        .imageColorSpace = colorSpace_,
        .imageExtent = extent,
        .imageArrayLayers = 1,
        .imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
        .preTransform = caps.currentTransform,
        .compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR,
        .presentMode = presentMode_,
        .clipped = VK_TRUE,
        .oldSwapchain = handle_};
    VkSwapchainKHR fresh = VK_NULL_HANDLE;
    AG_VK(device_.vk().CreateSwapchainKHR(device_.handle(), &info, nullptr, &fresh));
    device_.vk().DestroySwapchainKHR(device_.handle(), handle_, nullptr);
    handle_ = fresh;
    device_.context().setDebugName(VK_OBJECT_TYPE_SWAPCHAIN_KHR, handle_, "swapchain");
    uint32_t count = 0;
    device_.vk().GetSwapchainImagesKHR(device_.handle(), handle_, &count, nullptr);
    images_.resize(count);
    device_.vk().GetSwapchainImagesKHR(device_.handle(), handle_, &count, images_.data());
    for (VkImage image : images_)
        views_.push_back(makeView(device_, image, format_));
    for (uint32_t i = 0; i < count; ++i)
        rendered_.push_back(makeSemaphore(device_, "swapchain.rendered"));
    for (uint32_t i = 0; i <= count; ++i)
        acquired_.push_back(makeSemaphore(device_, "swapchain.acquired"));
    nextAcquire_ = 0;
}

VkResult Swapchain::tryAcquire(VkSemaphore acquired, uint32_t& index) {
    if (device_.context().strikes(Fault::kOutOfDate)) return VK_ERROR_OUT_OF_DATE_KHR;
    if (device_.context().strikes(Fault::kSurfaceLost)) return VK_ERROR_SURFACE_LOST_KHR;
    return device_.vk().AcquireNextImageKHR(device_.handle(), handle_, UINT64_MAX, acquired, VK_NULL_HANDLE,
                                            &index);
}

// A lost surface takes its swapchain with it; without another one there is nothing to go on with.
void Swapchain::renewSurface() {
    device_.waitIdle();
    destroyImages();
    device_.vk().DestroySwapchainKHR(device_.handle(), handle_, nullptr);
    handle_ = VK_NULL_HANDLE;
    if (const Status renewed = device_.renewSurface(); !renewed)
        checkVk(VK_ERROR_SURFACE_LOST_KHR, renewed.error().message.c_str());
}

std::optional<SwapchainImage> Swapchain::acquire(glm::uvec2 windowSize) {
    if (windowSize.x == 0 || windowSize.y == 0) return std::nullopt;
    if (stale_ || windowSize != requested_) create(windowSize);
    for (int attempt = 0; attempt < 2 && size_.x > 0 && size_.y > 0; ++attempt) {
        const VkSemaphore acquired = acquired_[nextAcquire_];
        uint32_t index = 0;
        const VkResult result = tryAcquire(acquired, index);
        if (result == VK_ERROR_SURFACE_LOST_KHR) renewSurface();
        if (result == VK_ERROR_SURFACE_LOST_KHR || result == VK_ERROR_OUT_OF_DATE_KHR) {
            create(windowSize);
            continue;
        }
        checkVk(result, "vkAcquireNextImageKHR");
        stale_ = result == VK_SUBOPTIMAL_KHR;
        nextAcquire_ = (nextAcquire_ + 1) % acquired_.size();
        return SwapchainImage{index, images_[index], views_[index], acquired, rendered_[index]};
    }
    return std::nullopt;
}

void Swapchain::present(const SwapchainImage& image) {
    const VkPresentInfoKHR info{.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                                .waitSemaphoreCount = 1,
                                .pWaitSemaphores = &image.rendered,
                                .swapchainCount = 1,
                                .pSwapchains = &handle_,
                                .pImageIndices = &image.index};
    const VkResult result = device_.vk().QueuePresentKHR(device_.queue(), &info);
    // A lost surface says so again when the next image is asked for.
    if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR ||
        result == VK_ERROR_SURFACE_LOST_KHR)
        stale_ = result != VK_ERROR_SURFACE_LOST_KHR;
    else
        checkVk(result, "vkQueuePresentKHR");
}

}  // namespace ag::gpu
