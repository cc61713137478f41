#include "gi/published/vpl_sampling.h"

namespace ag::gi {

Vals addVplSampling(GraphScope scope, const RsmSet& rsm, const Importance& importance, uint32_t count) {
    if (rsm.empty()) return {};
    struct Push {
        uint32_t vplCount, valCount, atlasWidth, mapCount, pyramidStride;
    };
    const Vals v = allocateVals(scope, "vpl_sampling.vals", "vpl_sampling.shapes", count);
    scope.compute("vpl_sampling.sample", "published/vpl_sampling/sample_vpls.comp")
        .read("texels", rsm.texels)
        .read("faces", rsm.faces)
        .read("maps", rsm.maps)
        .read("pyramid", importance.pyramid)
        .write("vals", v.vals)
        .write("shapes", v.shapes)
        .push(Push{count, v.count, rsm.atlas.size.x, rsm.atlas.mapCount, importance.pyramidStride})
        .dispatchThreads(v.count);
    return v;
}

}  // namespace ag::gi
