// The renderer's scene as gi/ chooses points on it: triangles, where they stand, what they reflect.
#pragma once

#include "engine/scene/render_scene.h"
#include "gi/bounce_points.h"
#include "gi/occluder_trees.h"

namespace ag::render {

// See gi/surface_sampling.h, gi/bounce_points.h. Alpha-blended surfaces have no points.
gi::SurfaceSamples sampleSurfaces(const RenderScene& scene, uint32_t count);
glm::vec3 albedoOf(const RenderScene& scene, uint32_t instance, glm::vec2 uv, bool whole);
// `whole`: they reflect what specular lobes do, too.
std::vector<io::BouncePoint> chooseBouncePoints(const RenderScene& scene, const gi::SurfaceSamples& samples,
                                                uint32_t count, bool whole);
// On emissive surfaces; their radiance is over `lightUnit`. Empty: nothing shines.
std::vector<io::BouncePoint> chooseEmissivePoints(const RenderScene& scene, uint32_t count, float lightUnit);
// How triangles of trees send light.
struct SurfaceLight {
    bool whole = false;  // they reflect what specular lobes do, too
    float unit = 1;      // their radiance is over it
    bool operator==(const SurfaceLight&) const = default;
};
gi::OccluderTrees buildTrees(const RenderScene& scene, gi::TreesOf of = gi::TreesOf::kAll,
                             SurfaceLight sent = {});
// `moving`: memory of a frame before.
void placeTrees(const RenderScene& scene, const gi::OccluderTrees& trees, bool movers,
                std::vector<gi::SampledInstance>& moving, gi::MoverTree& result);

}  // namespace ag::render
