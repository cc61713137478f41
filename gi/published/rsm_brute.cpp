// Dachsbacher & Stamminger 2005 without their sampling.
#include "gi/bounce_steps.h"
#include "gi/published/published.h"
#include "gi/published/texel_shading.h"

namespace ag::gi {

BounceLight addRsmBrute(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& s,
                        BounceLightHistory& h) {
    BounceLight f;
    addLightMaps(scope, in, s, h, f);
    const Surfaces thin = addThinned(scope, in.surfaces, s.spacing);
    f.irradiance = f.bounce1 = addTexelShading(scope, thin, f.rsm);
    addToPixels(scope, in, thin, s, h, f);
    h.probes.clear();
    return f;
}

}  // namespace ag::gi
