#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Of each tile of 8 x 8 pixels: the deviation of a new sample's luminance over some frames; what of the new samples stands
// out of it; by how much new samples and history disagree beyond what noise explains, 0 to 1. One group of lanes a tile. Noise
// is what differs from the history, where there is one: light that falls off within a tile is none.
#include "common/lanes.glsl"
#include "denoiser/surface.glsl"

layout(set = 0, binding = 0) uniform sampler2D samples;
layout(set = 0, binding = 1) uniform sampler2D history;
layout(set = 0, binding = 2, rgba16f) uniform writeonly image2D tiles;   // noise, change, lasting difference, 0
layout(set = 0, binding = 3, rgba16f) uniform writeonly image2D excess;  // what stands out, as a share of the light known there
layout(set = 0, binding = 4) uniform sampler2D previousTiles;
layout(push_constant) uniform Push { uint valid; } push;

const float kNoiseShare = 0.125;   // of a frame in the noise
const float kLastingShare = 0.25;  // of a frame in the mean difference

void main() {
    ivec2 tileCount = imageSize(tiles), size = textureSize(samples, 0);
    ivec2 tile = ivec2(gl_WorkGroupID.x % tileCount.x, gl_WorkGroupID.x / tileCount.x);
    const uint kPixels = kDenoiserTile * kDenoiserTile;
    float count = 0.0, sum = 0.0, squares = 0.0, both = 0.0, fresh = 0.0, old = 0.0, off = 0.0;
    for (uint i = laneIndex(); i < kPixels; i += kLanes) {
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
    count = max(laneAdd(count), 1.0);
    float mean = laneAdd(sum) / count, variance = max(laneAdd(squares) / count - mean * mean, 0.0);
    both = laneAdd(both);
    bool hasHistory = both > 0.5 * count;
    both = max(both, 1.0);
    float deviation2 = hasHistory ? laneAdd(off) / both : variance;
    fresh = laneAdd(fresh) / both;
    old = laneAdd(old) / both;
    // From two standard deviations of the means' difference on, all from four on: of this frame's and of a mean over some,
    // which finds what changes slowly.
    vec4 before = push.valid == 1 ? texelFetch(previousTiles, tile, 0) : vec4(sqrt(deviation2), vec3(0.0));
    float noise = sqrt(mix(before.x * before.x, deviation2, kNoiseShare));
    float uncertain = noise / sqrt(both) + 0.02 * max(fresh, old), differs = fresh - old;
    float lasting = mix(before.z, differs, kLastingShare);
    const float kLastingDeviation = sqrt(kLastingShare / (2.0 - kLastingShare));
    float deviations = max(abs(differs), abs(lasting) / kLastingDeviation) / max(uncertain, 1e-20);
    float change = old > 0.0 && fresh == 0.0 ? 1.0 : clamp(0.5 * deviations - 1.0, 0.0, 1.0);
    vec3 over = vec3(0.0);
    for (uint i = laneIndex(); i < kPixels; i += kLanes) {
        ivec2 pixel = tile * int(kDenoiserTile) + ivec2(i % kDenoiserTile, i / kDenoiserTile), at = min(pixel, size - 1);
        vec3 s = all(lessThan(pixel, size)) ? texelFetch(samples, at, 0).rgb : vec3(0.0);
        over += s - s * keptShare(luminance(s), texelFetch(history, at, 0), noise);
    }
    over = laneAdd(over) / max(old * both, 1e-20);  // old: mean of the known
    if (laneIndex() != 0) return;
    imageStore(tiles, tile, vec4(min(noise, 6e4), change, clamp(lasting, -6e4, 6e4), 0.0));
    imageStore(excess, tile, vec4(over, 0.0));
}
