#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
// Of the four cells about each pixel those on the same surface, bilinearly (Kopf et al. 2007). Where none is, the pixel is
// listed to look farther.
#include "upsampling/cell_light.glsl"
#define PIXEL_LIST_BINDING 5
#include "common/pixel_list.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 7, rgba16f) uniform writeonly image2D result;

const float kLeastWeight = 0.1;

void main() {
    ivec2 size = imageSize(result), pixel = min(ivec2(gl_GlobalInvocationID.xy), size - 1);
    Surface s = surfaceAt(pixel);
    vec2 at = cellsAt(pixel);
    ivec2 low = ivec2(floor(at));
    vec4 sum = vec4(0.0);
    float total = 0.0;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 cell = low + ivec2(i & 1, i >> 1);
        vec2 share = 1.0 - abs(vec2(cell) - at);
        float weight = share.x * share.y * likenessOf(s, cell);
        sum += weight * lightFor(s, cell);
        total += weight;
    }
    if (any(greaterThanEqual(ivec2(gl_GlobalInvocationID.xy), size))) return;
    bool found = total >= kLeastWeight;
    imageStore(result, pixel, found && s.depth > 0.0 ? withBase(pixel, sum / total) : vec4(0.0));
    if (!found && s.depth > 0.0) listPixel(pixel);
}
