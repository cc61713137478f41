#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_arithmetic : require
// Of each tile of 8 x 8 pixels: the deviation of a new sample's luminance, what of the new samples stands out above six of
// the samples' deviations, and by how much new samples and history disagree beyond what noise explains, 0 to 1. One
// subgroup a tile. Noise is what differs from the history, where there is one: light that falls off within a tile is none.
#include "common/lane_loop.glsl"
#include "denoiser/surface.glsl"

layout(local_size_x_id = 100) in;

layout(set = 0, binding = 0) uniform sampler2D samples;
layout(set = 0, binding = 1) uniform sampler2D history;
layout(set = 0, binding = 2, rgba16f) uniform writeonly image2D tiles;   // deviation, change, most luminance, 0
layout(set = 0, binding = 3, rgba16f) uniform writeonly image2D excess;  // W/m² that each of its pixels gets

const float kStandsOut = 6.0;

void main() {
    ivec2 tileCount = imageSize(tiles), size = textureSize(samples, 0);
    ivec2 tile = ivec2(gl_WorkGroupID.x % tileCount.x, gl_WorkGroupID.x / tileCount.x);
    const uint kPixels = kDenoiserTile * kDenoiserTile;
    float count = 0.0, sum = 0.0, squares = 0.0, both = 0.0, fresh = 0.0, old = 0.0, off = 0.0;
    for (uint i = gl_SubgroupInvocationID; i < kPixels; i += kSubgroupSize) {
        ivec2 pixel = tile * int(kDenoiserTile) + ivec2(i % kDenoiserTile, i / kDenoiserTile);
        bool inside = all(lessThan(pixel, size));
        ivec2 at = min(pixel, size - 1);
        vec4 h = texelFetch(history, at, 0);
        float l = inside ? luminance(texelFetch(samples, at, 0).rgb) : 0.0, known = inside && h.a > 0.0 ? 1.0 : 0.0;
        count += inside ? 1.0 : 0.0;
        sum += l;
        squares += l * l;
        both += known;
        fresh += known * l;
        old += known * luminance(h.rgb);
        off += known * (l - luminance(h.rgb)) * (l - luminance(h.rgb));
    }
    count = max(subgroupAdd(count), 1.0);
    float mean = subgroupAdd(sum) / count, variance = max(subgroupAdd(squares) / count - mean * mean, 0.0);
    both = subgroupAdd(both);
    bool hasHistory = both > 0.5 * count;
    both = max(both, 1.0);
    float deviation = sqrt(hasHistory ? subgroupAdd(off) / both : variance);
    fresh = subgroupAdd(fresh) / both;
    old = subgroupAdd(old) / both;
    // From one standard deviation of the means' difference on, all from three on.
    float uncertain = sqrt(variance / both) + 0.02 * max(fresh, old);
    float change = clamp(0.5 * abs(fresh - old) / max(uncertain, 1e-20) - 0.5, 0.0, 1.0);
    change = old > 0.0 && fresh == 0.0 ? 1.0 : change;
    float limit = mean + kStandsOut * sqrt(variance);
    vec3 over = vec3(0.0);
    for (uint i = gl_SubgroupInvocationID; i < kPixels; i += kSubgroupSize) {
        ivec2 pixel = tile * int(kDenoiserTile) + ivec2(i % kDenoiserTile, i / kDenoiserTile);
        vec3 s = all(lessThan(pixel, size)) ? texelFetch(samples, min(pixel, size - 1), 0).rgb : vec3(0.0);
        float l = luminance(s);
        over += l > limit ? s * (1.0 - limit / l) : vec3(0.0);
    }
    over = subgroupAdd(over) / count;
    if (gl_SubgroupInvocationID != 0) return;
    imageStore(tiles, tile, vec4(min(deviation, 6e4), change, min(limit, 6e4), 0.0));
    imageStore(excess, tile, vec4(over, 0.0));
}
