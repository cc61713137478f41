// What both gathers read. Needs the constant kShape.
#ifndef AG_GATHER_INPUTS_GLSL
#define AG_GATHER_INPUTS_GLSL

#include "common/texels.glsl"

layout(constant_id = 1) const int kVisibilityTaps = 0;
layout(constant_id = 7) const bool kDirected = false;  // also where the light comes from

layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 3) VEC4_TEXELS(vals);
layout(set = 0, binding = 4) VEC4_TEXELS(shapes);
layout(set = 0, binding = 5) VEC4_TEXELS(isms);
layout(set = 0, binding = 6) UINT_TEXELS(lists);
#include "val_shading/receiver.glsl"
#include "val_shading/screen_tiles.glsl"

layout(push_constant, scalar) uniform Push { ValShadingPush p; } push;
layout(set = 0, binding = 2, scalar) uniform Camera { CameraConstants camera; } camera;
layout(set = 0, binding = 7, scalar) readonly buffer Counts { uvec2 items[]; } counts;

// m, of a pixel's surface that faces the camera.
float widthOf(ivec2 pixel, float depth) {
    mat4 worldFromClip = camera.camera.worldFromClip;
    uvec2 size = camera.camera.size;
    vec3 here = worldFromPixel(worldFromClip, size, pixel, 1.0), next = worldFromPixel(worldFromClip, size, pixel + ivec2(1, 0), 1.0);
    return distance(here, next) / max(depth, 1e-9);
}
#endif
