// Our own Vulkan device with a queue (graphics, compute, transfer), another one for compute beside it where
// there is one, and the context of it that everything
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
#include "engine/gpu/queue.h"

namespace ag::gpu {

class PipelineLibrary;

// What a window needs of Vulkan.
struct WindowSurface {
    std::vector<const char*> instanceExtensions;
    std::function<VkResult(VkInstance, VkSurfaceKHR*)> make;
};

// What runs beside the main queue: nothing; a second queue where the device has one; work of its own on the
// main queue, as if there were two.
enum class AsyncQueue : uint8_t { kOff, kOn, kAlone };

// What goes to a queue at once.
struct Submission {
    VkCommandBuffer commands = VK_NULL_HANDLE;  // may be null
    Queue queue = Queue::kMain;
    uint64_t after = 0;                         // of the other queue's timeline, to wait for
    VkSemaphore waitBinary = VK_NULL_HANDLE;    // a swapchain's, may be null
    VkSemaphore signalBinary = VK_NULL_HANDLE;  // the same
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
    bool gpuKernels = false;  // the shape that kernels have on a GPU, on CPU devices too
    AsyncQueue asyncQueue = AsyncQueue::kOn;
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
    // Of the build's shaders, shared by all that works on the device: making one takes milliseconds. For one
    // thread at a time.
    PipelineLibrary& pipelines();

    VkQueue queue() const;
    VkSurfaceKHR surface() const;  // null when headless
    // After it was lost: another one of the same window. Nothing may be under way, no swapchain may be left.
    Status renewSurface();

    // Each queue has a timeline of submitted work: submit() signals the next value and returns it. Work of
    // the other queue is waited for by the main one before a frame ends, so that its values tell all.
    uint64_t submit(const Submission& work);
    uint64_t submit(VkCommandBuffer commands) { return submit(Submission{.commands = commands}); }
    uint64_t completedValue() const;  // of the main queue, as below
    uint64_t submittedValue() const;
    void waitFor(uint64_t timelineValue);  // fatal on device loss
    void waitIdle();

    void collect();  // what was retired and is done with

    // Nothing where the driver cannot tell (DeviceInfo::calibrated).
    std::optional<ClockPair> readClocks() const;

    // Records with `record`, submits and waits: for loading and tests.
    void runOnce(const std::function<void(VkCommandBuffer)>& record);
    uint64_t transfersWaitedFor() const;  // calls of runOnce() so far
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

}  // namespace ag::gpu
