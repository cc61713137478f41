// The renderer's own area lights read back: with the texels that each stands for and the map it is seen
// through, in metres and watts.
#pragma once

#include <span>
#include <vector>

#include "engine/renderer/renderer.h"
#include "shaders/val_fit/val_fit_io.h"

namespace ag::bench {

struct AreaLightRead {
    io::Val val;
    io::ValShapeVectors shape;
    uint32_t firstTexel = 0, texelCount = 0;
    float reach = 0;  // m, of the polygon's farthest corner from the centre
};

struct AreaLightSet {
    std::vector<AreaLightRead> lights;  // by their maps' places in the atlas
    std::vector<io::RsmTexel> texels;   // a light's lie together
    std::vector<float> weightUpTo;      // W, of a light's texels up to and with this one
    std::vector<glm::vec4> planes;      // of the maps' texels (ism_atlas_io.h)
    uint32_t mapSize = 0;               // texels along a map's side
    Image picture;                      // the first bounce as rendered, W/m²

    std::span<const io::RsmTexel> texelsOf(const AreaLightRead& light) const {
        return std::span(texels).subspan(light.firstTexel, light.texelCount);
    }
};

// After the clusters have settled. Fails with a sentence where the settings make no lights with maps of
// octahedral planes, or the scene has no light that bounces.
Result<AreaLightSet> readAreaLights(render::Renderer& renderer, const RenderScene& scene, glm::uvec2 size,
                                    const render::RenderSettings& settings);

}  // namespace ag::bench
