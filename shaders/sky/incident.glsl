// Light of the sky at a place, by one draw. Before: what draw.glsl needs.
#ifndef AG_SKY_INCIDENT_GLSL
#define AG_SKY_INCIDENT_GLSL

#include "common/sampling.h"
#include "sky/draw.glsl"

struct SkyIncident {
    vec3 direction;
    vec3 irradiance;  // W/m², if nothing stands between
};

SkyIncident drawSkyAt(vec3 normal, inout uint random) {
    vec3 xi;
    for (int i = 0; i < 3; ++i) {
        random = hashUint(random);
        xi[i] = unitOf(random);
    }
    SkyDraw d = drawSky(xi);
    float cosine = max(dot(normal, d.direction), 0.0);
    return SkyIncident(d.direction, d.density > 0.0 ? d.radiance * (cosine / d.density) : vec3(0.0));
}
#endif
