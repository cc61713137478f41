#include "gi/published/texel_shading.h"

#include <algorithm>
#include <array>
#include <string>

#include "engine/core/check.h"

namespace ag::gi {
namespace {

// Texels a pass meets: CPU devices end loops silently after 65,535 rounds, and watchdogs end long passes.
constexpr uint32_t kSliceTexels = 1u << 18;
// What all bounce lights' maps of the largest size hold.
constexpr uint32_t kMostSlices = io::kMaxBounceLights * 1024 * 1024 / kSliceTexels;

// The graph keeps views of pass names, so they live as long as the program.
std::string_view passName(uint32_t slice) {
    static const auto names = [] {
        std::array<std::string, kMostSlices> all;
        for (uint32_t i = 0; i < kMostSlices; ++i)
            all[i] = i == 0 ? "texel_shading.gather" : "texel_shading.gather" + std::to_string(i);
        return all;
    }();
    AG_CHECK(slice < kMostSlices);
    return names[slice];
}

}  // namespace

Irradiance addTexelShading(GraphScope scope, const Surfaces& gbuffer, const RsmSet& rsm) {
    if (rsm.empty()) return {};
    const uint32_t count = rsm.tileCount * io::kRsmTileSize * io::kRsmTileSize;
    const Irradiance result{scope.image("texel_shading.irradiance",
                                        {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = gbuffer.size})};
    for (uint32_t first = 0, slice = 0; first < count; first += kSliceTexels, ++slice) {
        PassBuilder pass = scope.compute(passName(slice), "published/texel_shading/gather_texels.comp");
        pass.sample("normalMap", gbuffer.normal)
            .sample("depthMap", gbuffer.depth)
            .read("camera", gbuffer.camera)
            .read("texels", rsm.texels)
            .constant("kFirst", slice == 0)
            .push(glm::uvec2(first, std::min(first + kSliceTexels, count)))
            .dispatchGroups((gbuffer.size.x + 15) / 16, (gbuffer.size.y + 15) / 16);
        if (slice == 0)
            pass.write("irradiance", result.image);
        else
            pass.readWrite("irradiance", result.image);
    }
    return result;
}

}  // namespace ag::gi
