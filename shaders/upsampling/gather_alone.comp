#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Pixels of surfaces that no gathered pixel lies on, as a lit reveal that is one pixel wide: all area lights, as polygons.
#include "upsampling/alone.glsl"

void main() {
    if (gl_GlobalInvocationID.x >= alone.count) return;
    AlonePixel p = alonePixel(gl_GlobalInvocationID.x);
    vec3 e = vec3(0.0);
    for (uint i = push.firstVal; i < push.valCount; ++i) {
        AreaLight l = loadLight(i);
        if (l.power.rgb != vec3(0.0)) e += irradianceFrom(l, p.position, p.normal.xyz, p.width, push.ismTileSize);
    }
    imageStore(result, p.pixel, vec4(min(e, vec3(kMostHalf)), 1.0));
}
