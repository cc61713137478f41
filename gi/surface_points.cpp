#include "gi/surface_points.h"

#include <algorithm>
#include <cmath>

#include "engine/core/hash.h"

namespace ag::gi {
namespace {

PointLayer layerOf(uint32_t first, uint32_t count) {
    if (count == 0) return {};
    return {.count = count,
            .firstSegment = first / io::kSegmentPoints,
            .segmentCount = (count + io::kSegmentPoints - 1) / io::kSegmentPoints};
}

}  // namespace

SurfacePoints addSurfacePoints(FrameGraph& graph, const SceneView& scene) {
    if (scene.surfaceSampleCount == 0) return {};
    SurfacePoints p{.count = scene.surfaceSampleCount, .stillVersion = scene.stillVersion};
    p.still = layerOf(0, scene.stillSampleCount);
    p.moving = layerOf(p.still.count, p.count - p.still.count);
    p.extent = scene.extent;
    p.points = graph.buffer("surface_points.points", {.sizeBytes = p.count * sizeof(io::SurfacePoint),
                                                      .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT});
    PassBuilder place =
        graph.compute("surface_points.place", scene.skin ? "surface_points/place_figure_points.comp"
                                                         : "surface_points/place_points.comp");
    place.read("instances", scene.instances)
        .read("samples", scene.surfaceSamples)
        .read("areas", scene.pointAreas)
        .write("points", p.points)
        .push(p.count)
        .key(scene.scene->instancesVersion)
        .dispatchThreads(p.count);
    readFigures(place, scene.skin);
    const uint32_t segments = p.still.segmentCount + p.moving.segmentCount;
    p.segments = graph.buffer("surface_points.segments", {.sizeBytes = segments * sizeof(io::SurfaceSegment),
                                                          .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT});
    graph.compute("surface_points.bound", "surface_points/bound_segments.comp")
        .read("points", p.points)
        .write("segments", p.segments)
        .push(p.count)
        .dispatchThreads(segments);
    return p;
}

}  // namespace ag::gi
