#include "gi/val_shading.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include "engine/core/check.h"

namespace ag::gi {
namespace {

// Lights a pass meets: CPU devices end loops silently after 65,535 rounds, and watchdogs end long passes.
constexpr uint32_t kSliceLights = 1u << 18;
// What all bounce lights' maps of the largest size hold.
constexpr uint32_t kMostSlices = io::kMaxBounceLights * 1024 * 1024 / kSliceLights;

// The graph keeps views of pass names, so they live as long as the program.
std::string_view passName(uint32_t slice) {
    static const auto names = [] {
        std::array<std::string, kMostSlices> all;
        for (uint32_t i = 0; i < kMostSlices; ++i)
            all[i] = i == 0 ? "val_shading.gather" : "val_shading.gather" + std::to_string(i);
        return all;
    }();
    AG_CHECK(slice < kMostSlices);
    return names[slice];
}

}  // namespace

Vals texelsAsVals(const RsmSet& rsm) {
    static_assert(sizeof(io::RsmTexel) == sizeof(io::Val) &&
                  offsetof(io::RsmTexel, normal) == offsetof(io::Val, normal) &&
                  offsetof(io::RsmTexel, flux) == offsetof(io::Val, flux));
    return {.vals = rsm.texels, .count = rsm.tileCount * io::kRsmTileSize * io::kRsmTileSize};
}

Irradiance addValShading(FrameGraph& graph, const SceneView& scene, const GBuffer& gbuffer, const Vals& vals,
                         const ValShadingSettings& settings) {
    if (vals.count == 0) return {};
    const Irradiance result{graph.image("val_shading.irradiance",
                                        {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = gbuffer.size})};
    for (uint32_t first = 0, slice = 0; first < vals.count; first += kSliceLights, ++slice) {
        PassBuilder pass = graph.compute(passName(slice), "val_shading/gather_vals.comp");
        pass.sample("normalMap", gbuffer.normal)
            .sample("depthMap", gbuffer.depth)
            .read("camera", scene.camera)
            .read("vals", vals.vals)
            .read("shapes", vals.shapes ? vals.shapes : vals.vals)
            .spec(0, uint32_t(settings.shape))
            .spec(1, slice == 0)
            .push(glm::uvec2(first, std::min(first + kSliceLights, vals.count)))
            .dispatchGroups((gbuffer.size.x + 15) / 16, (gbuffer.size.y + 15) / 16);
        if (slice == 0)
            pass.write("irradiance", result.image);
        else
            pass.readWrite("irradiance", result.image);
    }
    return result;
}

}  // namespace ag::gi
