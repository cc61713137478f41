#include "gi/val_fit.h"

#include <algorithm>

#include "shaders/bvh/bvh_io.h"

namespace ag::gi {
namespace {

// Lights come in whole subgroups.
uint32_t paddedCount(uint32_t count) {
    constexpr uint32_t kLargestSubgroup = 64;
    return (count + kLargestSubgroup - 1) / kLargestSubgroup * kLargestSubgroup;
}

template <class Row>
BufferInfo rows(uint32_t count) {
    return {.sizeBytes = count * sizeof(Row), .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT};
}

BufferHandle addSights(GraphScope scope, const RsmSet& rsm, const Clusters& clusters, const Occluders& traced,
                       const io::ValFitPush& push) {
    const uint32_t count = clusters.count * io::kSightPlaces * io::kSightTexels;
    const BufferHandle sights = scope.buffer("val_fit.sights", {.sizeBytes = count * sizeof(uint32_t)});
    scope.compute("val_fit.trace_sights", "val_fit/trace_sights.comp")
        .read("clusters", clusters.clusters)
        .read("extents", clusters.extents)
        .read("texels", rsm.texels)
        .read("treeNodes", traced.trees.nodes)
        .read("treeTriangles", traced.trees.triangles)
        .readPart("treePlaces", traced.trees.places, traced.trees.staticVersion)
        .write("sights", sights)
        .push(push)
        .dispatchThreads(count);
    return sights;
}

}  // namespace

Vals allocateVals(GraphScope scope, std::string_view vals, std::string_view shapes, uint32_t count) {
    Vals v{.count = paddedCount(count)};
    v.vals = scope.buffer(vals, rows<io::Val>(v.count));
    v.shapes = scope.buffer(shapes, rows<io::ValShapeVectors>(v.count));
    return v;
}

Vals valsBetween(Vals vals, uint32_t begin, uint32_t end) {
    vals.count = std::min(vals.count, end);
    vals.first = std::min(vals.count, std::max(vals.first, begin));
    return vals;
}

Vals addValFit(GraphScope scope, const RsmSet& rsm, const SurfaceEmitters& emitters, const Clusters& clusters,
               const Occluders* traced) {
    if (clusters.count == 0) return {};
    Vals v{.count = paddedCount(clusters.count)};
    const HistoryBuffer vals = scope.historyBuffer("val_fit.vals", rows<io::Val>(v.count));
    v.vals = vals.current;
    v.shapes = scope.buffer("val_fit.shapes", rows<io::ValShapeVectors>(v.count));
    const io::ValFitPush push{.clusterCount = clusters.count,
                              .valCount = v.count,
                              .atlasWidth = rsm.atlas.size.x,
                              .known = vals.valid,
                              .offset = traced ? io::kBvhOffset * traced->extent : 0};
    const BufferHandle sights = traced ? addSights(scope, rsm, clusters, *traced, push) : rsm.texels;
    scope.compute("val_fit.fit", "val_fit/fit_vals.comp")
        .constant("kTraced", traced != nullptr)
        .read("clusters", clusters.clusters)
        .read("extents", clusters.extents)
        .read("texels", rsm.texels)
        .read("faces", rsm.faces)
        .read("maps", rsm.maps)
        .read("edges", emitters.edges ? emitters.edges : rsm.texels)
        .read("sights", sights)
        .readPrevious("previousVals", vals)
        .write("vals", v.vals)
        .write("shapes", v.shapes)
        .push(push)
        .dispatchThreads(v.count);
    return v;
}

}  // namespace ag::gi
