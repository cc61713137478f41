// Depth maps of the lights that cast shadows: spot one view, point six, sun cascades fitted to the camera.
// Two atlases, so that cascades moving with the camera do not redraw the maps of lamps that stand still.
#pragma once

#include <array>
#include <vector>

#include "gi/scene_gpu.h"
#include "shaders/shadow_maps/shadow_maps_io.h"

namespace ag::gi {

struct ShadowMapSettings {
    uint32_t resolution = 1024;  // texels along a spot's or cascade's side; cube faces half of it
    uint32_t cascades = 3;       // of each sun, 1 to 4
    float cascadeDistance = 60;  // m from the camera the last cascade reaches; cut to the scene
    float cascadeSplit = 0.75f;  // 0 uniform, 1 logarithmic
    float nearDistance = 0.02f;  // m, of spot and point views
};

struct LightShadow {
    uint32_t firstView = 0;
    uint32_t viewCount = 0;  // 0: casts none
};

struct ShadowMaps {
    ImageHandle lampAtlas, sunAtlas;                   // D32; invalid if unused
    BufferHandle views;                                // io::ShadowView of all
    std::array<LightShadow, io::kMaxLights> lights{};  // parallel to the scene's lights
};

ShadowMaps addShadowMaps(FrameGraph& graph, const SceneView& scene, const ShadowMapSettings& settings);

}  // namespace ag::gi
