#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Lists the pixels whose specular lobe is narrow.
#define PIXEL_LIST_BINDING 3
#include "common/pixel_list.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push { float roughness; } push;
layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2) uniform sampler2D reflectanceMap;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, textureSize(depthMap, 0)))) return;
    if (texelFetch(normalMap, pixel, 0).w >= push.roughness || texelFetch(depthMap, pixel, 0).x <= 0.0) return;
    if (texelFetch(reflectanceMap, pixel, 0).w > 0.0) listPixel(pixel);
}
