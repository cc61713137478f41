// Weinzierl-Heigl, Adaptively-Clustered Reflective Shadow Maps.
#include "gi/bounce_steps.h"
#include "gi/published/published.h"

namespace ag::gi {

BounceLight addAcrsm(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& s,
                     const InterleavedShadingSettings& interleaved, BounceLightHistory& h) {
    BounceLight f;
    f.viewPoints = addViewPoints(scope, in.surfaces);
    addAreaLights(scope, in, s, h, f);
    f.firstCount = f.vals.count;
    addVisibility(scope, in, s.ismAtlas, f);
    const Surfaces downsampled = addDownsampled(scope, in.surfaces, s.spacing);
    f.irradiance = f.bounce1 =
        addInterleavedShading(scope, downsampled, {f.vals, f.isms}, s.valShading, interleaved.side);
    f.gloss = addValGloss(scope, in.surfaces, in.surfaces, {f.vals, f.isms}, s.valShading);
    addToPixels(scope, in, downsampled, s, h, f);
    addProbes(scope, {in.probes, in.lightUnit}, f.rsm, {f.vals, f.isms}, s.probes, h.probes);
    return f;
}

}  // namespace ag::gi
