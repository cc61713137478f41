// The hemisphere about +z on the unit square, octahedral: straight edges, texels of much the same solid angle
// (0.32 to 1.66 times the mean), and no trigonometry.
#ifndef AG_HEMISPHERE_MAP_H
#define AG_HEMISPHERE_MAP_H

#include "common/portable.h"

AG_BEGIN

// d need not be unit; d.z >= 0.
AG_FUNCTION vec2 hemisphereEncode(vec3 d) {
    float inverse = 0.5f / max(abs(d.x) + abs(d.y) + d.z, 1e-20f);
    return vec2(d.x + d.y, d.x - d.y) * inverse + vec2(0.5f);
}

// How the two coordinates grow with d (not unit; the map depends on its direction alone), per its length.
AG_FUNCTION void hemisphereGradients(vec3 d, AG_OUT(vec3) u, AG_OUT(vec3) v) {
    float sum = max(abs(d.x) + abs(d.y) + d.z, 1e-20f), half_ = 0.5f / sum;
    vec3 sumGradient = vec3(d.x < 0.0f ? -1.0f : 1.0f, d.y < 0.0f ? -1.0f : 1.0f, 1.0f) / sum;
    u = vec3(half_, half_, 0.0f) - sumGradient * ((d.x + d.y) * half_);
    v = vec3(half_, -half_, 0.0f) - sumGradient * ((d.x - d.y) * half_);
}

// The direction, not unit.
AG_FUNCTION vec3 hemisphereDirection(vec2 uv) {
    vec2 e = uv * 2.0f - vec2(1.0f);
    vec2 p = vec2(e.x + e.y, e.x - e.y) * 0.5f;
    return vec3(p.x, p.y, max(1.0f - abs(p.x) - abs(p.y), 0.0f));
}

AG_FUNCTION vec3 hemisphereDecode(vec2 uv) {
    return normalize(hemisphereDirection(uv));
}

AG_END
#endif
