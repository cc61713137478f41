// The hemisphere about +z on the unit square. Octahedral: straight edges, texels of much the same solid angle
// (0.32 to 1.66 times the mean), and no trigonometry. Paraboloid (Heidrich & Seidel 1998), as the sources
// have it: on the disk within the square, texels of 1 to 4 times the solid angle.
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

// d need not be unit; d.z >= 0.
AG_FUNCTION vec2 paraboloidEncode(vec3 d) {
    float inverse = 0.5f / max(length(d) + d.z, 1e-20f);
    return vec2(d.x, d.y) * inverse + vec2(0.5f);
}

// As hemisphereGradients.
AG_FUNCTION void paraboloidGradients(vec3 d, AG_OUT(vec3) u, AG_OUT(vec3) v) {
    float distance_ = max(length(d), 1e-20f), inverse = 1.0f / max(distance_ + d.z, 1e-20f);
    vec3 slope = (d / distance_ + vec3(0.0f, 0.0f, 1.0f)) * inverse;
    u = (vec3(1.0f, 0.0f, 0.0f) - slope * d.x) * (0.5f * inverse);
    v = (vec3(0.0f, 1.0f, 0.0f) - slope * d.y) * (0.5f * inverse);
}

// The direction, not unit; below the plane outside the disk.
AG_FUNCTION vec3 paraboloidDirection(vec2 uv) {
    vec2 p = uv * 2.0f - vec2(1.0f);
    return vec3(2.0f * p.x, 2.0f * p.y, 1.0f - dot(p, p));
}

AG_END
#endif
