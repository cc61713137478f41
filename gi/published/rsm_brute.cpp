// Dachsbacher & Stamminger 2005 without their sampling.
#include "gi/bounce_steps.h"
#include "gi/published/published.h"
#include "gi/published/texel_shading.h"

namespace ag::gi {

BounceLight addRsmBrute(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& s,
                        BounceLightHistory& h) {
    BounceLight f;
    addRsms(scope, in, s, h, f);
    const Surfaces downsampled = addDownsampled(scope, in.surfaces, s.spacing);
    f.irradiance = f.bounce1 = addTexelShading(scope, downsampled, f.rsm);
    addToPixels(scope, in, downsampled, s, h, f);
    h.probes.readings.clear();
    return f;
}

}  // namespace ag::gi
