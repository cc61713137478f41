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

constexpr uint32_t kPlaceGroup = 64, kBoundGroup = 64;  // invocations

// What is static is worked on once, in groups of so many points; a group that has some of both counts as
// movable.
void addLayers(PassBuilder& pass, const SurfacePoints& p, uint64_t movableVersion, uint32_t groupPoints) {
    const uint32_t staticGroups = p.staticLayer.count / groupPoints,
                   all = (p.count + groupPoints - 1) / groupPoints;
    if (staticGroups > 0) pass.part(0, staticGroups, p.staticVersion);
    if (all > staticGroups)
        pass.part(staticGroups, all - staticGroups, combineHash(p.staticVersion, movableVersion));
}

}  // namespace

SurfacePoints addSurfacePoints(GraphScope scope, const Occluders& o, uint64_t instancesVersion) {
    if (o.sampleCount == 0) return {};
    SurfacePoints p{.count = o.sampleCount, .staticVersion = o.staticVersion};
    p.staticLayer = layerOf(0, o.staticSampleCount);
    p.movableLayer = layerOf(p.staticLayer.count, p.count - p.staticLayer.count);
    p.extent = o.extent;
    p.points = scope.buffer("surface_points.points", {.sizeBytes = p.count * sizeof(io::SurfacePoint),
                                                      .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT});
    PassBuilder place =
        scope.compute("surface_points.place", o.deformedPositions ? "surface_points/place_skinned_points.comp"
                                                                  : "surface_points/place_points.comp");
    place.read("instances", o.instances)
        .read("samples", o.samples)
        .read("areas", o.pointAreas)
        .parts("points", p.points)
        .push(io::PointPush{.pointCount = p.count});
    readDeformed(place, o);
    addLayers(place, p, instancesVersion, kPlaceGroup);
    const uint32_t segments = p.staticLayer.segmentCount + p.movableLayer.segmentCount;
    p.segments = scope.buffer("surface_points.segments", {.sizeBytes = segments * sizeof(io::SurfaceSegment),
                                                          .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT});
    PassBuilder bound = scope.compute("surface_points.bound", "surface_points/bound_segments.comp");
    bound.read("points", p.points).parts("segments", p.segments).push(io::PointPush{.pointCount = p.count});
    addLayers(bound, p, instancesVersion, io::kSegmentPoints * kBoundGroup);
    return p;
}

void readDeformed(PassBuilder& pass, const Occluders& o) {
    if (!o.deformedPositions) return;
    pass.read("deformedPositions", o.deformedPositions).read("deformedAttributes", o.deformedAttributes);
}

}  // namespace ag::gi
