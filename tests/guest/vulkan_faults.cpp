#include "tests/guest/vulkan_faults.h"

#include <string_view>

#include "engine/gpu/functions.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/device_environment.h"

namespace ag::test {
namespace {

constexpr int kNever = 1 << 30;
int gCalls = 0, gUntilFailure = kNever;
VkResult gResult = VK_SUCCESS;
bool gFailed = false;

bool strikes() {
    ++gCalls;
    if (gFailed) return gResult == VK_ERROR_DEVICE_LOST;
    return gFailed = gUntilFailure-- == 0;
}

constexpr bool mayFail(std::string_view name) {
    for (const std::string_view verb : {"Create", "Allocate", "Bind", "Map"})
        if (name.starts_with(verb)) return true;
    return false;
}

enum class Function {
#define X(name) name,
    AG_VULKAN_DEVICE_FUNCTIONS(X)
#undef X
};

// What the driver and the layers allocate is theirs.
template <Function kFunction, bool kMayFail, class Pointer>
struct Hook;
template <Function kFunction, bool kMayFail, class R, class... Arguments>
struct Hook<kFunction, kMayFail, R(VKAPI_PTR*)(Arguments...)> {
    static inline R(VKAPI_PTR* real)(Arguments...) = nullptr;
    static R VKAPI_PTR call(Arguments... arguments) {
        if constexpr (kMayFail)
            if (strikes()) return gResult;
        const UncountedAllocations theirs;
        return real(arguments...);
    }
    static PFN_vkVoidFunction over(PFN_vkVoidFunction found) {
        real = reinterpret_cast<decltype(real)>(found);
        return found ? PFN_vkVoidFunction(&call) : nullptr;
    }
};

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL faultyGetDeviceProcAddr(VkDevice device, const char* name) {
    const UncountedAllocations theirs;
    const PFN_vkVoidFunction found = test::device().vk().GetDeviceProcAddr(device, name);
#define X(known)                               \
    if (std::string_view(name) == "vk" #known) \
        return Hook<Function::known, mayFail(#known), PFN_vk##known>::over(found);
    AG_VULKAN_DEVICE_FUNCTIONS(X)
#undef X
    return found;
}

}  // namespace

void failVulkanAfter(int count, VkResult result) {
    gCalls = 0;
    gUntilFailure = count;
    gResult = result;
    gFailed = false;
}

void vulkanWorks() {
    failVulkanAfter(kNever, VK_SUCCESS);
}

int countedVulkanCalls() {
    return gCalls;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL faultyGetInstanceProcAddr(VkInstance instance, const char* name) {
    if (std::string_view(name) == "vkGetDeviceProcAddr") return PFN_vkVoidFunction(&faultyGetDeviceProcAddr);
    const UncountedAllocations theirs;
    return device().vk().GetInstanceProcAddr(instance, name);
}

}  // namespace ag::test
