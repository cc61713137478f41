// Irradiance straight from the scene's suns, one pass each.
#pragma once

#include "engine/renderer/shadow_maps.h"
#include "gi/surfaces.h"
#include "gi/val_shading.h"
#include "shaders/direct_lighting/direct_lighting_io.h"

namespace ag::render {

struct DirectLight {
    ImageHandle image;       // irradiance, rgba16f, W/m²; invalid: no light
    ImageHandle highlights;  // what specular lobes add, rgba16f, W/(m² sr); invalid: no material has one
};

// Into `light`: makes its images where there are none, and binds what highlights need. `glossy`: they are
// asked for.
void bindDirectLight(GraphScope scope, const gi::Surfaces& gbuffer, bool glossy, PassBuilder& pass,
                     DirectLight& light);

// Of shadow rays through trees.
io::RayOffsets shadowRayOffsets(const gi::Occluders& traced);
// What a pass reads that casts shadow rays: trees, and the textures that cut masked triangles out.
void readShadowTrees(PassBuilder& pass, const SceneView& scene, const gi::TracedOccluders& trees);

// `traced`: occluders that have trees, if shadows are found by rays.
DirectLight addSunLighting(GraphScope scope, const SceneView& scene, const gi::Surfaces& gbuffer,
                           const ShadowMaps& shadows, const gi::Occluders* traced, bool glossy);

}  // namespace ag::render
