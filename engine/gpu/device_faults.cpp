#include "engine/gpu/device_faults.h"

#include <fmt/format.h>
#include <vulkan/vk_enum_string_helper.h>

#include <array>
#include <charconv>
#include <string_view>

#include "engine/core/failure.h"

namespace ag::gpu {
namespace {

std::string sentence(VkResult result, const char* call) {
    switch (result) {
        case VK_ERROR_DEVICE_LOST:
            return fmt::format("the graphics device was lost (in {})", call);
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            return fmt::format(
                "the graphics device is out of memory (in {}): a smaller size or a lower quality needs less",
                call);
        default:
            return fmt::format("{} failed: {}", call, string_VkResult(result));
    }
}

FailureKind kindOf(VkResult result) {
    if (result == VK_ERROR_DEVICE_LOST) return FailureKind::kDeviceLost;
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY) return FailureKind::kDeviceMemory;
    if (result == VK_ERROR_OUT_OF_HOST_MEMORY) return FailureKind::kHostMemory;
    return FailureKind::kDevice;
}

struct NamedFault {
    std::string_view name;
    Fault kind;
};
constexpr std::array kFaults = {
    NamedFault{"allocation", Fault::kAllocation}, NamedFault{"submit", Fault::kSubmit},
    NamedFault{"out_of_date", Fault::kOutOfDate}, NamedFault{"surface_lost", Fault::kSurfaceLost}};

}  // namespace

void checkVk(VkResult result, const char* call) {
    if (result >= 0) return;  // success codes such as VK_INCOMPLETE are the caller's business
    fail(kindOf(result), sentence(result, call));
}

Result<FaultPlan> parseFaultPlan(const std::string& text) {
    if (text.empty()) return FaultPlan{};
    const size_t colon = std::min(text.find(':'), text.size());
    FaultPlan plan;
    for (const NamedFault& f : kFaults)
        if (f.name == text.substr(0, colon)) plan.kind = f.kind;
    const char* end = text.data() + text.size();
    const char* number = text.data() + std::min(colon + 1, text.size());
    const auto [stop, error] = std::from_chars(number, end, plan.occasion);
    if (plan.kind == Fault::kNone || error != std::errc() || stop != end || plan.occasion == 0)
        return Error{fmt::format(
            "a fault is allocation:N, submit:N, out_of_date:N or surface_lost:N, not '{}'", text)};
    return plan;
}

}  // namespace ag::gpu
