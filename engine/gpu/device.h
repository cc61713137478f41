// Our own Vulkan device with one queue (graphics, compute, transfer), and the context of it that everything
// else works on. bufferDeviceAddress stays off so that RenderDoc can capture on lavapipe.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/gpu/context.h"

namespace ag::gpu {

// What a window needs of Vulkan.
struct WindowSurface {
    std::vector<const char*> instanceExtensions;
    std::function<VkResult(VkInstance, VkSurfaceKHR*)> make;
};

struct DeviceOptions {
    bool validation = false;              // core and synchronization validation; messages are counted
    std::optional<WindowSurface> window;  // none: headless, no surface or swapchain extension
    std::string deviceName;  // part of a device name to prefer; empty: discrete, integrated, then CPU
    // Features to do without and limits to take as lower ("maxImageDimension2D=4096"), as if the device had
    // no more.
    std::vector<std::string> without;
    // Instead of subgroups workgroups of so many lanes that share memory, 4 to 64; 0: as the device can.
    uint32_t sharedLanes = 0;
    FaultPlan fault;  // for tests
};

// The same moment on the device's clock and on the host's (std::chrono::steady_clock).
struct ClockPair {
    uint64_t deviceTicks = 0, hostNs = 0;
};

class Device {
  public:
    static Result<std::unique_ptr<Device>> create(const DeviceOptions& options);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    Context& context();
    operator Context&() { return context(); }
    const Functions& vk() const { return asContext().vk(); }
    VkDevice handle() const { return asContext().handle(); }
    const DeviceInfo& info() const { return asContext().info(); }
    uint32_t queueFamily() const { return asContext().queueFamily(); }
    MemoryAllocator& memory() { return context().memory(); }

    VkQueue queue() const;
    VkSurfaceKHR surface() const;  // null when headless
    // After it was lost: another one of the same window. Nothing may be under way, no swapchain may be left.
    Status renewSurface();

    // The one timeline of submitted work: submit() signals the next value and returns it.
    // `waitBinary`/`signalBinary`: swapchain semaphores, may be null.
    uint64_t submit(VkCommandBuffer commands, VkSemaphore waitBinary = VK_NULL_HANDLE,
                    VkSemaphore signalBinary = VK_NULL_HANDLE);
    uint64_t completedValue() const;
    uint64_t submittedValue() const;
    void waitFor(uint64_t timelineValue);  // fatal on device loss
    void waitIdle();

    void collect();  // what was retired and is done with

    // Nothing where the driver cannot tell (DeviceInfo::calibrated).
    std::optional<ClockPair> readClocks() const;

    // Records with `record`, submits and waits: for loading and tests.
    void runOnce(const std::function<void(VkCommandBuffer)>& record);
    // The same; the process CPU time that took, ms, driver threads included: the true cost on a CPU device.
    double timeOnCpu(const std::function<void(VkCommandBuffer)>& record);

    // Warnings and errors of the validation layers so far (also those while creating the device).
    int validationMessageCount() const;

  private:
    explicit Device(const DeviceOptions& options);
    const Context& asContext() const;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// Validation messages of all devices ever made in this process, also those reported while one is destroyed.
int totalValidationMessages();

}  // namespace ag::gpu
