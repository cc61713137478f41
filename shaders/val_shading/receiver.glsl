// A pixel that area lights shine on.
#ifndef AG_RECEIVER_GLSL
#define AG_RECEIVER_GLSL

#include "val_shading/area_light.glsl"

struct Receiver {
    vec3 position, normal;
    float width;      // m, of the pixel there
    vec3 irradiance;  // sum
};

void addLight(AreaLight l, uint ismTileSize, inout Receiver r) {
    r.irradiance += irradianceFrom(l, r.position, r.normal, r.width, ismTileSize);
}
#endif
