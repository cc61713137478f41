// What the camera sees, rasterised once: depth, shading normal, diffuse albedo, emission. Alpha-blended
// surfaces are not in it.
#pragma once

#include "gi/scene_gpu.h"

namespace ag::gi {

struct GBuffer {
    ImageHandle depth;     // D32, reversed, 0: no surface
    ImageHandle normal;    // rgba16f: unit normal; roughness
    ImageHandle albedo;    // rgba16f: diffuse albedo; metallic
    ImageHandle emissive;  // rgba16f, W/(m² sr); invalid when no material emits
    glm::uvec2 size{0};
};

GBuffer addGBuffer(FrameGraph& graph, const SceneView& scene);

// io::kViewPointCount surface points that stand for the view: io::ViewPoint, also a texel buffer of vec4.
BufferHandle addViewPoints(FrameGraph& graph, const SceneView& scene, const GBuffer& gbuffer);

}  // namespace ag::gi
