#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
// Gloss of the four cells about each pixel, of those on the same surface whose lobe points the same way and is as wide, by
// how much more or less the pixel reflects. Where there are none, the pixel is listed to meet the lights by itself.
#include "upsampling/surface.glsl"
#define PIXEL_LIST_BINDING 7
#include "common/pixel_list.glsl"
#include "val_shading/lobe.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 4) uniform sampler2D reflectanceMap;
layout(set = 0, binding = 5) uniform sampler2D cellReflectance;
layout(set = 0, binding = 6) uniform sampler2D cellGloss;
layout(set = 0, binding = 9, rgba16f) uniform writeonly image2D result;

const float kLeastWeight = 0.1;
const float kMostTurn = 0.5;  // of the lobe's width, by which normals may be apart
const float kLeastReflectance = 1e-3;

// 1 for the same lobe, else less.
float lobeLikeness(vec4 a, vec4 b) {  // normal, roughness
    float wide = lobeWidth(min(a.w, b.w)), turn = 2.0 * max(1.0 - dot(a.xyz, b.xyz), 0.0), narrow = lobeWidth(max(a.w, b.w));
    float alike = wide / narrow;
    return alike * alike * exp2(-turn / (kMostTurn * kMostTurn * wide * wide));
}

struct Pixel {
    Surface surface;
    vec4 normal, reflectance;
};

struct Sum {
    vec3 radiance;
    float weight;
};

// A cell's gloss as the pixel reflects it, by how alike the two are.
void addCell(Pixel p, ivec2 cell, float share, inout Sum sum) {
    ivec2 there = clamp(cell, ivec2(0), textureSize(cellDepths, 0) - 1);
    vec3 other = texelFetch(cellReflectance, there, 0).rgb;
    vec3 ratio = max(p.reflectance.rgb, kLeastReflectance) / max(other, kLeastReflectance);
    bool even = max(ratio.x, max(ratio.y, ratio.z)) < 2.0 && min(ratio.x, min(ratio.y, ratio.z)) > 0.5;
    float alike = likenessOf(p.surface, cell) * lobeLikeness(p.normal, texelFetch(cellNormals, there, 0));
    float weight = even ? share * alike : 0.0;
    sum.radiance += weight * ratio * texelFetch(cellGloss, there, 0).rgb;
    sum.weight += weight;
}

void main() {
    ivec2 size = imageSize(result), pixel = min(ivec2(gl_GlobalInvocationID.xy), size - 1);
    Pixel p = Pixel(surfaceAt(pixel), texelFetch(normalMap, pixel, 0), texelFetch(reflectanceMap, pixel, 0));
    vec2 at = cellsAt(pixel);
    Sum sum = Sum(vec3(0.0), 0.0);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 cell = ivec2(floor(at)) + ivec2(i & 1, i >> 1);
        vec2 share = 1.0 - abs(vec2(cell) - at);
        addCell(p, cell, share.x * share.y, sum);
    }
    bool glossy = p.surface.depth > 0.0 && any(greaterThan(p.reflectance, vec4(0.0)));
    if (any(greaterThanEqual(ivec2(gl_GlobalInvocationID.xy), size))) return;
    bool found = sum.weight >= kLeastWeight;
    imageStore(result, pixel, vec4(glossy && found ? sum.radiance / sum.weight : vec3(0.0), 1.0));
    if (glossy && !found) listPixel(pixel);
}
