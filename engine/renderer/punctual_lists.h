// The punctual lights in view as shaders have them, and for each tile of the screen the list of those that
// reach it.
#pragma once

#include "engine/renderer/light_clusters.h"
#include "engine/renderer/scene_gpu.h"
#include "gi/surfaces.h"
#include "shaders/direct_lighting/direct_lighting_io.h"

namespace ag::render {

struct PunctualLists {
    // io::PunctualLight, sorted by cluster; also a texel buffer of vec4. Invalid: none in view.
    BufferHandle lights;
    BufferHandle lists, counts;  // of indices into them, kMaxPunctualLightsPerTile places a tile
    uint32_t lightCount = 0;
    glm::uvec2 tiles{0};
};

struct PunctualListsHistory {  // scratch, so that a steady frame allocates nothing
    std::vector<io::PunctualLight> lights;
    std::vector<uint32_t> order;
};

// `byRange` false: every tile has all lights.
PunctualLists addPunctualLists(GraphScope scope, const SceneView& scene, const gi::Surfaces& gbuffer,
                               const LightClusters& clusters, bool byRange, PunctualListsHistory& history);

}  // namespace ag::render
