#include "gi/val_shading.h"

#include <cstddef>

namespace ag::gi {

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
    graph.compute("val_shading.gather", "val_shading/gather_vals.comp")
        .sample("normalMap", gbuffer.normal)
        .sample("depthMap", gbuffer.depth)
        .read("camera", scene.camera)
        .read("vals", vals.vals)
        .write("irradiance", result.image)
        .spec(0, uint32_t(settings.shape))
        .push(vals.count)
        .dispatchGroups((gbuffer.size.x + 15) / 16, (gbuffer.size.y + 15) / 16);
    return result;
}

}  // namespace ag::gi
