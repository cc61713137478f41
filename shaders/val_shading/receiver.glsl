// A pixel that area lights shine on.
#ifndef AG_RECEIVER_GLSL
#define AG_RECEIVER_GLSL

#include "val_shading/area_light.glsl"

const float kLeastCosine = 0.5;  // of lights low over the surface, whose middle says little

struct Receiver {
    vec3 position, normal;
    float width;      // m, of the pixel there
    vec3 irradiance;  // sum
    vec3 toward;      // sum of the vector irradiance, all channels: along a normal it is what would arrive there
};

void addLight(AreaLight l, uint ismTileSize, inout Receiver r) {
    vec3 e = irradianceFrom(l, r.position, r.normal, r.width, ismTileSize);
    r.irradiance += e;
    if (!kDirected) return;
    vec3 d = l.place.xyz - r.position;
    float inverse = inversesqrt(max(dot(d, d), 1e-12)), cosine = dot(r.normal, d) * inverse;
    r.toward += d * (inverse * (e.x + e.y + e.z) / max(cosine, kLeastCosine));
}
#endif
