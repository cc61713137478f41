// A lamp in registers and what it sends to a place. Needs texel buffer `lamps`.
#ifndef AG_LAMP_GLSL
#define AG_LAMP_GLSL

#include "direct_lighting/direct_lighting_io.h"

Lamp lampAt(uint index) {
    int at = int(index) * 4;
    vec4 a = texelFetch(lamps, at), b = texelFetch(lamps, at + 1), c = texelFetch(lamps, at + 2);
    vec4 d = texelFetch(lamps, at + 3);
    Lamp lamp;
    lamp.position = a.xyz;
    lamp.inverseRange2 = a.w;
    lamp.intensity = b.xyz;
    lamp.cluster = floatBitsToUint(b.w);
    lamp.axis = c.xyz;
    lamp.coneOffset = c.w;
    lamp.clusterDistance = d.x;
    lamp.id = floatBitsToUint(d.yz);
    return lamp;
}

// spotFalloff and rangeWindow of lights.h, with the divisions done before. `distance2`: m².
vec3 irradianceFrom(Lamp lamp, vec3 position, vec3 normal, out float distance2) {
    vec3 d = lamp.position - position;
    distance2 = max(dot(d, d), 1e-8);
    float inverse = inversesqrt(distance2), s2 = distance2 * lamp.inverseRange2;
    float cone = clamp(dot(d, lamp.axis) * inverse + lamp.coneOffset, 0.0, 1.0);
    float window = clamp(1.0 - s2 * s2, 0.0, 1.0);
    return lamp.intensity * (max(dot(normal, d), 0.0) * cone * cone * window * (inverse / distance2));
}

// How much a lamp has of its cluster's shadow: all from far away, less the wider the angle between lamp and centre is.
float shadowWeight(Lamp lamp, float distance2, float reach) {
    float needed = reach * lamp.clusterDistance;
    return distance2 < needed * needed ? sqrt(distance2) / needed : 1.0;
}
#endif
