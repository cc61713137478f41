#include "engine/gpu/context.h"

namespace ag::gpu {

Context::Context(const Functions& vk, const ContextHandles& handles, DeviceInfo info, MemorySource memory,
                 FaultPlan fault)
    : vk_(vk), handles_(handles), info_(std::move(info)), faults_(fault), memory_(*this, std::move(memory)) {}

Context::~Context() {
    finish(UINT64_MAX);
}

void Context::finish(uint64_t work) {
    while (!retired_.empty() && retired_.front().work <= work) {
        const std::function<void()> destroy = std::move(retired_.front().destroy);
        retired_.pop_front();
        destroy();
    }
}

void Context::retire(std::function<void()> destroy) {
    retired_.push_back({recording_, std::move(destroy)});
}

}  // namespace ag::gpu
