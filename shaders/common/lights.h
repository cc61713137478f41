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

// What a light of 1 W/sr that nothing hides sends to a place, W/m² on a plane that faces it. `away`: unit,
// from the light; `distance`: m. Cosines below -1: a light to all sides.
AG_FUNCTION float punctualIrradiance(vec3 away, float distance, vec3 axis, float cosInner, float cosOuter,
                                     float range) {
    float d = max(distance, 1e-4f);
    return spotFalloff(dot(away, axis), cosInner, cosOuter) * rangeWindow(d, range) / (d * d);
}

// The cube face a direction points to: +x -x +y -y +z -z.
AG_FUNCTION uint cubeFace(vec3 d) {
    vec3 a = abs(d);
    if (a.x >= a.y && a.x >= a.z) return d.x > 0.0f ? 0u : 1u;
    if (a.y >= a.z) return d.y > 0.0f ? 2u : 3u;
    return d.z > 0.0f ? 4u : 5u;
}

AG_END
#endif
