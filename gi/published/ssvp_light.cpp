// Aranha, Macedo, Apolinario: the lights, and among them what they light.
#include "gi/bounce_steps.h"
#include "gi/later_bounces.h"
#include "gi/published/published.h"

namespace ag::gi {

BounceLight addSsvpLight(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& s,
                         const SsvpSettings& ssvp, DrawParaboloids draw, BounceLightHistory& h) {
    BounceLight f;
    addRsms(scope, in, s, h, f);
    const Ssvp propagated = addSsvp(scope, f.rsm, s.valClustering.count, ssvp, draw);
    f.vals = propagated.vals, f.firstCount = propagated.firstCount;
    if (s.ismAtlas.enabled) f.isms = propagated.maps;
    const Surfaces downsampled = addDownsampled(scope, in.surfaces, s.spacing);
    f.irradiance = f.bounce1 = addInterleavedShading(
        scope, downsampled, {valsBetween(f.vals, 0, f.firstCount), f.isms}, s.valShading, ssvp.interleave);
    if (f.bounce1.image && f.vals.count > f.firstCount)
        f.irradiance = addInterleavedShading(scope, downsampled, {f.vals, f.isms}, s.valShading,
                                             ssvp.interleave, kAllInterleaved);
    addToPixels(scope, in, downsampled, s, h, f);
    h.probes.readings.clear();  // they know no maps that lights share
    return f;
}

}  // namespace ag::gi
