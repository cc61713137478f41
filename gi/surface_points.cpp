#include "gi/surface_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/hash.h"

namespace ag::gi {

SurfacePoints addSurfacePoints(FrameGraph& graph, const SceneView& scene) {
    if (scene.surfaceSampleCount == 0) return {};
    SurfacePoints p{.count = scene.surfaceSampleCount};
    p.version = combineHash(combineHash(scene.scene->geometry->version, scene.scene->instancesVersion),
                            scene.scene->originVersion);
    p.segmentCount = (p.count + io::kSegmentPoints - 1) / io::kSegmentPoints;
    p.radius = std::sqrt(scene.surfaceArea / (std::numbers::pi_v<float> * float(p.count)));
    p.extent = std::max(glm::length(scene.scene->bounds.max - scene.scene->bounds.min), 1e-6f);
    p.points = graph.buffer("surface_points.points", {.sizeBytes = p.count * sizeof(io::SurfacePoint),
                                                      .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT});
    graph.compute("surface_points.place", "surface_points/place_points.comp")
        .read("instances", scene.instances)
        .read("samples", scene.surfaceSamples)
        .write("points", p.points)
        .push(p.count)
        .key(scene.scene->instancesVersion)
        .dispatchThreads(p.count);
    p.segments =
        graph.buffer("surface_points.segments", {.sizeBytes = p.segmentCount * sizeof(io::SurfaceSegment),
                                                 .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT});
    graph.compute("surface_points.bound", "surface_points/bound_segments.comp")
        .read("points", p.points)
        .write("segments", p.segments)
        .push(p.count)
        .dispatchThreads(p.segmentCount);
    return p;
}

}  // namespace ag::gi
