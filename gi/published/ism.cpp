// Keller 1997 with shadows by Ritschel et al. 2008.
#include "gi/bounce_steps.h"
#include "gi/published/published.h"
#include "gi/published/vpl_sampling.h"

namespace ag::gi {

BounceLight addIsm(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& s,
                   const InterleavedShadingSettings& interleaved, BounceLightHistory& h) {
    BounceLight f;
    f.viewPoints = addViewPoints(scope, in.surfaces);
    addRsms(scope, in, s, h, f);
    f.importance = addImportance(scope, f.rsm, f.viewPoints, s.importance);
    f.vals = addVplSampling(scope, f.rsm, f.importance, s.valClustering.count);
    f.firstCount = f.vals.count;
    addVisibility(scope, in, s.ismAtlas, f);
    const Surfaces downsampled = addDownsampled(scope, in.surfaces, s.spacing);
    f.irradiance = f.bounce1 =
        addInterleavedShading(scope, downsampled, {f.vals, f.isms}, s.valShading, interleaved.side);
    addToPixels(scope, in, downsampled, s, h, f);
    addProbes(scope, {in.probes, in.lightUnit}, f.rsm, {f.vals, f.isms}, s.probes, h.probes);
    return f;
}

}  // namespace ag::gi
