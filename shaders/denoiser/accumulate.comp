#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// New samples into what is known: a plain mean at first, then one that forgets. Where light changes beyond noise the new
// samples count for more and the history is taken for short.
#include "denoiser/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push { AccumulatePush p; } push;

layout(set = 0, binding = 0) uniform sampler2D samples;
layout(set = 0, binding = 1) uniform sampler2D history;
layout(set = 0, binding = 2) uniform sampler2D tiles;
layout(set = 0, binding = 3) uniform sampler2D excess;
layout(set = 0, binding = 4, rgba16f) uniform writeonly image2D light;

void main() {
    ivec2 size = imageSize(light), pixel = ivec2(gl_GlobalInvocationID.xy), at = min(pixel, size - 1);
    vec3 fresh = texelFetch(samples, at, 0).rgb;
    vec4 old = texelFetch(history, at, 0);
    vec2 where = (vec2(at) + 0.5) / float(kDenoiserTile) / vec2(textureSize(tiles, 0));
    ivec2 tile = at / int(kDenoiserTile);
    float change = push.p.changing == 1 ? textureLod(tiles, where, 0.0).y : 0.0;
    if (push.p.spread == 1) 
        fresh = fresh * keptShare(luminance(fresh), old, texelFetch(tiles, tile, 0).x) + texelFetch(excess, tile, 0).rgb * luminance(old.rgb);
    float length_ = min(old.a, push.p.mostLength - 1.0) * (1.0 - change) + 1.0;
    float share = max(old.a > 0.0 ? push.p.leastShare : 1.0, 1.0 / length_);
    vec3 mean = mix(old.rgb, fresh, share);
    if (all(lessThan(pixel, size))) imageStore(light, pixel, vec4(roundedByChance(mean, pixel, push.p.seed), length_));
}
