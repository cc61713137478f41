// Punctual lights as KHR_lights_punctual has them.
#ifndef AG_LIGHTS_H
#define AG_LIGHTS_H

#include "common/portable.h"

AG_BEGIN

// Share of the axial intensity at an angle from a spot's axis: t², t linear in the cosine.
AG_FUNCTION float spotFalloff(float cosAngle, float cosInner, float cosOuter) {
    float t = clamp((cosAngle - cosOuter) / max(cosInner - cosOuter, 1e-4f), 0.0f, 1.0f);
    return t * t;
}

// Windows the irradiance to end at `range` (m); 0 means no end.
AG_FUNCTION float rangeWindow(float distance, float range) {
    float s = distance / max(range, 1e-6f);
    float s2 = s * s;
    return range > 0.0f ? clamp(1.0f - s2 * s2, 0.0f, 1.0f) : 1.0f;
}

AG_END
#endif
