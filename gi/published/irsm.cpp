// Improved reflective shadow maps.
#include "gi/bounce_steps.h"
#include "gi/published/published.h"

namespace ag::gi {

BounceLight addIrsm(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& s,
                    BounceLightHistory& h) {
    BounceLight f;
    addRsms(scope, in, s, h, f);
    const Surfaces downsampled = addDownsampled(scope, in.surfaces, s.spacing);
    f.irradiance = f.bounce1 = addStochasticRsm(scope, in.world.versions, downsampled, {.rsm = f.rsm},
                                                s.stochasticRsm, h.stochasticRsm);
    addToPixels(scope, in, downsampled, s, h, f);  // denoised
    h.probes.readings.clear();
    return f;
}

}  // namespace ag::gi
