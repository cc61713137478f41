#include "gi/blue_noise.h"

// 64 x 64 pairs of bytes, put into the program by the assembler.
extern "C" const std::byte afterglow_blue_noise[];

namespace ag::gi {
namespace {

constexpr size_t kBytes = 64 * 64 * 4;

}  // namespace

BufferHandle addBlueNoise(GraphScope scope) {
    if (const BufferHandle known = scope.findBuffer("blue_noise.pixels"))
        return known;  // another asked before
    const BufferHandle buffer =
        scope.buffer("blue_noise.pixels", {.sizeBytes = kBytes, .texelFormat = VK_FORMAT_R32_UINT});
    scope.upload("blue_noise.pixels", buffer, std::span(afterglow_blue_noise, kBytes));
    return buffer;
}

glm::vec3 blueNoiseShift(uint32_t step) {
    return glm::vec3(
        glm::fract(double(step) * glm::dvec3(0.8191725133961645, 0.6710436067037893, 0.5497004779019703)));
}

}  // namespace ag::gi
