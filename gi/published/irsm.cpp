// Improved reflective shadow maps.
#include "gi/bounce_steps.h"
#include "gi/published/published.h"

namespace ag::gi {

BounceLight addIrsm(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& s,
                    BounceLightHistory& h) {
    BounceLight f;
    addLightMaps(scope, in, s, h, f);
    const Surfaces thin = addThinned(scope, in.surfaces, s.spacing);
    f.irradiance = f.bounce1 =
        addStochasticRsm(scope, in.world.versions, thin, f.rsm, {}, s.stochasticRsm, h.stochasticRsm);
    addToPixels(scope, in, thin, s, h, f);  // denoised
    h.probes.clear();
    return f;
}

}  // namespace ag::gi
