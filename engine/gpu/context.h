// The Vulkan device that our code works on, whoever made it: its functions, what it can do, its memory.
// Nothing here submits or waits. A host's device is adopted as it is; our own (device.h) is one user more.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "engine/gpu/debug_name.h"
#include "engine/gpu/device_faults.h"
#include "engine/gpu/device_info.h"
#include "engine/gpu/memory.h"

namespace ag::gpu {

struct ContextHandles {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;  // with requiredFeatures() on
    uint32_t queueFamily = 0;          // of the command buffers recorded into: graphics and compute
    // Of work beside it; none: there is no second queue. The same: images need no change of their owner.
    std::optional<uint32_t> asyncFamily;
    VkPipelineCache pipelineCache = VK_NULL_HANDLE;         // may be null
    const VkAllocationCallbacks* hostAllocation = nullptr;  // outlives the context; may be null
};

class Context {
  public:
    // `vk`: with the device's functions loaded (functions.h).
    Context(const Functions& vk, const ContextHandles& handles, DeviceInfo info, MemorySource memory = {},
            FaultPlan fault = {});
    ~Context();  // the device is done with all that was recorded
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    const Functions& vk() const { return vk_; }
    VkInstance instance() const { return handles_.instance; }
    VkPhysicalDevice physical() const { return handles_.physical; }
    VkDevice handle() const { return handles_.device; }
    uint32_t queueFamily() const { return handles_.queueFamily; }
    std::optional<uint32_t> asyncFamily() const { return handles_.asyncFamily; }
    // Whether buffers and images meet queues of two families.
    bool twoFamilies() const { return handles_.asyncFamily.value_or(queueFamily()) != queueFamily(); }
    VkPipelineCache pipelineCache() const { return handles_.pipelineCache; }
    const VkAllocationCallbacks* hostAllocation() const { return handles_.hostAllocation; }
    const DeviceInfo& info() const { return info_; }
    MemoryAllocator& memory() { return memory_; }
    bool strikes(Fault kind) { return faults_.strikes(kind); }  // a fault on purpose, for tests

    // Work is numbered from 1 by whoever submits it: what is recorded from now on, and up to which the device
    // is done.
    void record(uint64_t work) { recording_ = work; }
    void finish(uint64_t work);
    // Runs `destroy` once the device is done with all recorded so far.
    void retire(std::function<void()> destroy);

    template <class Handle>
    void setDebugName(VkObjectType type, Handle handle, const std::string& name) const {
        gpu::setDebugName(vk_, handles_.device, type, handle, name);
    }

  private:
    struct Retired {
        uint64_t work;
        std::function<void()> destroy;
    };
    Functions vk_;
    ContextHandles handles_;
    DeviceInfo info_;
    FaultCounter faults_;
    MemoryAllocator memory_;
    uint64_t recording_ = 1;
    std::deque<Retired> retired_;
};

}  // namespace ag::gpu
