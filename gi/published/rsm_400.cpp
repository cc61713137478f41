// Dachsbacher & Stamminger 2005: one fixed pattern of samples for all pixels.
#include "gi/bounce_steps.h"
#include "gi/published/published.h"

namespace ag::gi {

BounceLight addRsm400(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& s,
                      BounceLightHistory& h) {
    BounceLight f;
    addRsms(scope, in, s, h, f);
    const Surfaces downsampled = addDownsampled(scope, in.surfaces, s.spacing);
    f.irradiance = f.bounce1 = addStochasticRsm(scope, in.world.versions, downsampled, {.rsm = f.rsm},
                                                s.stochasticRsm, h.stochasticRsm);
    addToPixels(scope, in, downsampled, s, h, f);
    h.probes.readings.clear();
    return f;
}

}  // namespace ag::gi
