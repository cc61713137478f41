// One Vulkan 1.3 device with one queue (graphics, compute, transfer).
// Required features: dynamicRendering, synchronization2, timelineSemaphore, scalarBlockLayout,
// hostQueryReset, multiDrawIndirect, drawIndirectFirstInstance; subgroup shuffle, ballot and arithmetic in
// compute. bufferDeviceAddress stays off so that RenderDoc can capture on lavapipe.
#pragma once

#include "engine/gpu/functions.h"

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/gpu/debug_name.h"
#include "engine/gpu/device_faults.h"
#include "engine/gpu/memory.h"

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
    std::vector<std::string> without;  // features and extensions to do without, as if the device lacked them
    FaultPlan fault;                   // for tests
};

struct DeviceInfo {
    std::string name;    // "llvmpipe (LLVM 15.0.6, 256 bits)"
    std::string driver;  // driver name and version
    uint32_t apiVersion = 0;
    uint32_t subgroupSize = 0;
    float timestampPeriodNs = 0;  // 0: no timestamps
    bool calibrated = false;      // the device's clock can be read together with the host's
    bool counts = false;          // pipeline statistics
    bool isCpu = false;           // lavapipe and its like: kernels take their lane-parallel shape
    VkPhysicalDeviceLimits limits{};
    std::vector<std::string> enabled;  // feature and extension names switched on
    std::vector<std::string> missing;  // "name: what is done without it"
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

    const Functions& vk() const;
    VkInstance instance() const;
    VkPhysicalDevice physical() const;
    VkDevice handle() const;
    VkQueue queue() const;
    uint32_t queueFamily() const;
    VkSurfaceKHR surface() const;  // null when headless
    // After it was lost: another one of the same window. Nothing may be under way, no swapchain may be left.
    Status renewSurface();
    bool strikes(Fault kind);  // see DeviceOptions::fault
    VkPipelineCache pipelineCache() const;
    const DeviceInfo& info() const;

    MemoryAllocator& memory();

    // The one timeline of submitted work: submit() signals the next value and returns it.
    // `waitBinary`/`signalBinary`: swapchain semaphores, may be null.
    uint64_t submit(VkCommandBuffer commands, VkSemaphore waitBinary = VK_NULL_HANDLE,
                    VkSemaphore signalBinary = VK_NULL_HANDLE);
    uint64_t completedValue() const;
    uint64_t submittedValue() const;
    void waitFor(uint64_t timelineValue);  // fatal on device loss
    void waitIdle();

    // Runs `destroy` once all work submitted so far, and what is being recorded, has finished (checked in
    // collect()).
    void retire(std::function<void()> destroy);
    void collect();

    // Nothing where the driver cannot tell (DeviceInfo::calibrated).
    std::optional<ClockPair> readClocks() const;

    // Records with `record`, submits and waits: for loading and tests.
    void runOnce(const std::function<void(VkCommandBuffer)>& record);

    // Warnings and errors of the validation layers so far (also those while creating the device).
    int validationMessageCount() const;
    template <class Handle>
    void setDebugName(VkObjectType type, Handle handle, const std::string& name) {
        gpu::setDebugName(vk(), this->handle(), type, handle, name);
    }

  private:
    explicit Device(const DeviceOptions& options);
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// Validation messages of all devices ever made in this process, also those reported while one is destroyed.
int totalValidationMessages();

}  // namespace ag::gpu
