// What the camera sees, rasterised once: depth, shading normal, diffuse albedo, emission. Alpha-blended
// surfaces are not in it.
#pragma once

#include "engine/renderer/scene_gpu.h"
#include "gi/inputs.h"

namespace ag::render {

struct GBuffer {
    gi::Surfaces surfaces;  // without motion: see addMotion
    ImageHandle emissive;   // rgba16f, W/(m² sr); invalid when no material emits
};

GBuffer addGBuffer(GraphScope scope, const SceneView& scene);

// Where the surfaces that moved since the frame before were then; only what moved is drawn. None: invalid.
ImageHandle addMotion(GraphScope scope, const SceneView& scene, const gi::Surfaces& surfaces);

}  // namespace ag::render
