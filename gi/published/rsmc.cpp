// Prutkin, Kaplanyan, Dachsbacher 2012.
#include "gi/bounce_steps.h"
#include "gi/published/published.h"

namespace ag::gi {

BounceLight addRsmc(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& s,
                    BounceLightHistory& h) {
    BounceLight f;
    f.viewPoints = addViewPoints(scope, in.surfaces);
    addAreaLights(scope, in, s, h, f);
    f.firstCount = f.vals.count;
    const Surfaces downsampled = addDownsampled(scope, in.surfaces, s.spacing);
    f.irradiance = f.bounce1 = addValShading(scope, downsampled, {f.vals, f.isms}, s.valShading);
    f.gloss = addValGloss(scope, in.surfaces, in.surfaces, {f.vals, f.isms}, s.valShading);
    addToPixels(scope, in, downsampled, s, h, f);
    addProbes(scope, {in.probes, in.lightUnit}, f.rsm, {f.vals, f.isms}, s.probes, h.probes);
    return f;
}

}  // namespace ag::gi
