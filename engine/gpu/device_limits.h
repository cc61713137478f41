// The limits of Vulkan devices that our code leans on, and the least of each that it runs with. Where a
// device has less, it is refused; where a scene or a setting wants more than a device has, the program takes
// smaller maps, or ends with a sentence that names the limit.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/gpu/functions.h"

namespace ag::gpu {

struct DeviceLimit {
    std::string_view name;  // "maxTexelBufferElements"
    uint32_t least;         // below it nothing runs; tests hold it against the shaders
    uint32_t& (*of)(VkPhysicalDeviceLimits&);
};
std::span<const DeviceLimit> deviceLimits();
const DeviceLimit* findDeviceLimit(std::string_view name);  // null: not one of these

// As if the device had less, for tests.
struct LoweredLimit {
    const DeviceLimit* limit;
    uint32_t most;
};
void lowerLimits(std::span<const LoweredLimit> lowered, VkPhysicalDeviceLimits& limits);
// What is below the least, as "maxX of N (it has M)".
std::vector<std::string> lackingLimits(VkPhysicalDeviceLimits limits);

// Fails (failure.h): `what` wants `wanted` of a limit, which is more than the device has.
[[noreturn]] void failBeyondLimit(const std::string& what, std::string_view limit, uint64_t wanted,
                                  uint64_t has);

// Whether texel buffers hold whatever Vulkan lets any storage buffer hold, in words. Where not, shaders read
// storage buffers instead (shaders/common/texels.glsl).
bool hasLargeTexelBuffers(const VkPhysicalDeviceLimits& limits);

// maxPerStageDescriptorStorageBuffers that rays to texels want where they read storage buffers instead; the
// least limit is for all else.
constexpr uint32_t kStorageBuffersOfRays = 16;

}  // namespace ag::gpu
