#include "gi/val_fit.h"

#include <algorithm>

namespace ag::gi {

Vals allocateVals(GraphScope scope, std::string_view vals, std::string_view shapes, uint32_t count) {
    constexpr uint32_t kLargestSubgroup = 64;
    Vals v{.count = (count + kLargestSubgroup - 1) / kLargestSubgroup * kLargestSubgroup};
    v.vals = scope.buffer(
        vals, {.sizeBytes = v.count * sizeof(io::Val), .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT});
    v.shapes = scope.buffer(shapes, {.sizeBytes = v.count * sizeof(io::ValShapeVectors),
                                     .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT});
    return v;
}

Vals firstVals(Vals vals, uint32_t end) {
    vals.count = std::min(vals.count, end);
    return vals;
}

Vals laterVals(Vals vals, uint32_t first) {
    vals.first = std::min(vals.count, first);
    return vals;
}

Vals addValFit(GraphScope scope, const RsmSet& rsm, const LaterLight& later, const Clusters& clusters) {
    if (clusters.count == 0) return {};
    const Vals v = allocateVals(scope, "val_fit.vals", "val_fit.shapes", clusters.count);
    scope.compute("val_fit.fit", "val_fit/fit_vals.comp")
        .read("clusters", clusters.clusters)
        .read("extents", clusters.extents)
        .read("texels", rsm.texels)
        .read("faces", rsm.faces)
        .read("maps", rsm.maps)
        .read("edges", later.edges ? later.edges : rsm.texels)
        .write("vals", v.vals)
        .write("shapes", v.shapes)
        .push(glm::uvec3(clusters.count, v.count, rsm.atlas.size.x))
        .dispatchThreads(v.count);
    return v;
}

}  // namespace ag::gi
