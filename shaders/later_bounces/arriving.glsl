// Light without a reflective shadow map at a place. Before: push.p.reach, m: beyond it nothing stands.
#ifndef AG_ARRIVING_GLSL
#define AG_ARRIVING_GLSL

#include "common/lights.h"
#include "later_bounces/later_bounces_io.h"

struct Arriving {
    vec3 irradiance;  // unshadowed
    vec3 toLight;     // unit
    float distance;
};

Arriving arrivingFrom(PointLight l, vec3 place, vec3 normal) {
    if (l.directional != 0) return Arriving(l.intensity * max(-dot(normal, l.direction), 0.0), -l.direction, push.p.reach);
    vec3 d = l.position - place;
    float distance_ = max(length(d), 1e-6);
    vec3 toLight = d / distance_;
    float facing = punctualIrradiance(-toLight, distance_, l.direction, l.cosInner, l.cosOuter, l.range);
    return Arriving(l.intensity * (facing * max(dot(normal, toLight), 0.0)), toLight, distance_);
}

float most(vec3 v) { return max(v.x, max(v.y, v.z)); }
#endif
