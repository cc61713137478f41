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
    ImageHandle
        reflectance;     // rgba16f: specular, head on; at grazing angles; invalid when no material is glossy
    ImageHandle motion;  // rgba16f: m to where the surface was a frame ago; invalid when nothing moved
    const ViewDraws* draws = nullptr;  // what the camera draws, for addMotion
    glm::uvec2 size{0};
    bool bent = false;     // normals of a surface differ from pixel to pixel: it has a normal map
    uint32_t spacing = 1;  // of the camera's pixels from one of these to the next
    RenderCamera view;     // of these pixels
    BufferHandle camera;   // the same as io::CameraConstants
};

GBuffer addGBuffer(GraphScope scope, const SceneView& scene);

// Passes and resources; literals, because the graph keeps views of them.
struct ThinningNames {
    std::string_view depth, normal, camera;
};
constexpr ThinningNames kThinning = {"gbuffer.thin_depth", "gbuffer.thin_normal", "gbuffer.thin_camera"};
constexpr ThinningNames kLaterThinning = {"gbuffer.thin_depth_later", "gbuffer.thin_normal_later",
                                          "gbuffer.thin_camera_later"};

// Every spacing-th pixel of every spacing-th row, as if the camera had no others: from the middle of each
// square of the image, what is left over at its right and lower border goes without. Depth and normal only;
// itself with a spacing of 1.
GBuffer addThinned(GraphScope scope, const GBuffer& all, uint32_t spacing,
                   const ThinningNames& names = kThinning);

// The same of an image, rgba16f.
ImageHandle addThinImage(GraphScope scope, std::string_view name, ImageHandle all, uint32_t spacing);

// Where the surfaces that moved since the frame before were then; only what moved is drawn. None: invalid.
ImageHandle addMotion(GraphScope scope, const SceneView& scene, const GBuffer& gbuffer);

// io::kViewPointCount surface points that stand for the view: io::ViewPoint, also a texel buffer of vec4.
BufferHandle addViewPoints(GraphScope scope, const SceneView& scene, const GBuffer& gbuffer);

}  // namespace ag::gi
