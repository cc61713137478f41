// A punctual light in registers and what it sends to a place. Needs texel buffer `lights`.
#ifndef AG_PUNCTUAL_LIGHT_GLSL
#define AG_PUNCTUAL_LIGHT_GLSL

#include "direct_lighting/direct_lighting_io.h"

PunctualLight punctualLightAt(uint index) {
    int at = int(index) * 4;
    vec4 a = fetchTexel(lights, at), b = fetchTexel(lights, at + 1), c = fetchTexel(lights, at + 2);
    vec4 d = fetchTexel(lights, at + 3);
    PunctualLight light;
    light.position = a.xyz;
    light.inverseRange2 = a.w;
    light.intensity = b.xyz;
    light.cluster = floatBitsToUint(b.w);
    light.axis = c.xyz;
    light.coneOffset = c.w;
    light.clusterDistance = d.x;
    light.id = floatBitsToUint(d.yz);
    return light;
}

// spotFalloff and rangeWindow of lights.h, with the divisions done before. `distance2`: m².
vec3 irradianceFrom(PunctualLight light, vec3 position, vec3 normal, out float distance2) {
    vec3 d = light.position - position;
    distance2 = max(dot(d, d), 1e-8);
    float inverse = inversesqrt(distance2), s2 = distance2 * light.inverseRange2;
    float cone = clamp(dot(d, light.axis) * inverse + light.coneOffset, 0.0, 1.0);
    float window = clamp(1.0 - s2 * s2, 0.0, 1.0);
    return light.intensity * (max(dot(normal, d), 0.0) * cone * cone * window * (inverse / distance2));
}

// How much a light has of its cluster's shadow: all from far away, less the wider the angle between light and centre is.
float shadowWeight(PunctualLight light, float distance2, float reach) {
    float needed = reach * light.clusterDistance;
    return distance2 < needed * needed ? sqrt(distance2) / needed : 1.0;
}
#endif
