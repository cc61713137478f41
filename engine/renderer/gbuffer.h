// What the camera sees, rasterised once: depth, shading normal, diffuse albedo, emission. What blends with
// what is behind it is apart, a layer after another.
#pragma once

#include "engine/renderer/scene_gpu.h"
#include "gi/inputs.h"

namespace ag::render {

struct GBuffer {
    gi::Surfaces surfaces;  // without motion: see addMotion
    ImageHandle emissive;   // rgba16f, W/(m² sr); invalid when no material emits
};

GBuffer addGBuffer(GraphScope scope, const SceneView& scene);

// Whether the camera sees everything where it saw it in the frame before.
class Standstill {
  public:
    // Once a frame; true in the first.
    bool next(const SceneView& scene);

  private:
    uint64_t before_ = 0;  // 0: there was no frame
};

struct BlendedSurfaces {
    GBuffer gbuffer;   // as if they were opaque, but that what passes through glass is not reflected
    ImageHandle veil;  // rgba16f: what they let through of the light behind them; how much they cover
};

struct PeeledBetween {
    ImageHandle opaque;    // depth of what is opaque, of the whole picture
    ImageHandle nearer;    // depth of the layer before; none: this one is the nearest
    glm::uvec2 origin{0};  // of scene.grid in the whole picture
};
// Of what `draws` has the nearest surface at each pixel that lies between. `glossy`: what a sheet reflects
// does not pass it.
BlendedSurfaces addBlendedSurfaces(GraphScope scope, const SceneView& scene, const ViewDraws& draws,
                                   const PeeledBetween& between, bool glossy);

// Where the surfaces that moved since the frame before were then; only what moved is drawn. None: invalid.
ImageHandle addMotion(GraphScope scope, const SceneView& scene, const gi::Surfaces& surfaces);

}  // namespace ag::render
