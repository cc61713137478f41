// Light drawn for a place that a ray met. Before: what bvh/trace.glsl and sky/draw.glsl need.
#ifndef AG_INCIDENT_GLSL
#define AG_INCIDENT_GLSL

#include "common/random.glsl"
#include "sky/draw.glsl"

struct Incident {
    vec3 toward;
    float reach;  // of the ray that asks for it, in lengths of toward
    vec3 sends;   // W/m², if nothing stands between
};

const Incident kNoIncident = Incident(vec3(0.0), 0.0, vec3(0.0));

// Of the sky, by one draw. `reach`, m: beyond it nothing stands.
Incident drawSkyAt(vec3 normal, float reach, inout uint random) {
    vec3 xi;
    for (int i = 0; i < 3; ++i) xi[i] = next(random);
    SkyDraw d = drawSky(xi);
    float cosine = max(dot(normal, d.direction), 0.0);
    return Incident(d.direction, reach, d.density > 0.0 ? d.radiance * (cosine / d.density) : vec3(0.0));
}

// What of it reaches the place, W/m².
vec3 arrivingAt(vec3 start, Incident light, float opaqueFrom) {
    BvhRay ray = BvhRay(start, light.toward, light.reach, opaqueFrom, true, 0, 0);
    return light.sends != vec3(0.0) && !traceOccluders(ray) ? light.sends : vec3(0.0);
}
#endif
