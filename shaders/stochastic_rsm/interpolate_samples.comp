#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Pixels whose gathered neighbours lie on about the same plane take their blend; the others are listed to be
// gathered themselves (Dachsbacher & Stamminger 2005, section 4).
#include "gbuffer/gbuffer.glsl"
#include "stochastic_rsm/stochastic_rsm_io.h"
#define PIXEL_LIST_BINDING 4
#include "common/pixel_list.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(push_constant, scalar) uniform Push { RsmInterpolationPush p; } push;

layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2, scalar) uniform Camera { CameraConstants camera; } camera;
layout(set = 0, binding = 3) uniform sampler2D coarse;
layout(set = 0, binding = 6, rgba16f) writeonly uniform image2D irradiance;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = ivec2(camera.camera.size);
    if (any(greaterThanEqual(pixel, size))) return;
    int step = int(push.p.step);
    float depth = texelFetch(depthMap, pixel, 0).x;
    vec3 x = worldFromPixel(camera.camera.worldFromClip, uvec2(size), pixel, depth);
    vec3 n = texelFetch(normalMap, pixel, 0).xyz;
    float reach = push.p.mostPlaneShare * camera.camera.near / max(depth, 1e-9);

    ivec2 last = textureSize(coarse, 0) - 1;
    vec2 at = (vec2(pixel) - float(step / 2)) / float(step);
    ivec2 low = ivec2(floor(at));
    vec2 f = at - vec2(low);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    int accepted = 0;
    for (int i = 0; i < 4; ++i) {
        ivec2 cell = clamp(low + ivec2(i & 1, i >> 1), ivec2(0), last);
        ivec2 sampled = min(cell * step + step / 2, size - 1);
        float sampleDepth = texelFetch(depthMap, sampled, 0).x;
        vec3 y = worldFromPixel(camera.camera.worldFromClip, uvec2(size), sampled, sampleDepth);
        vec3 m = texelFetch(normalMap, sampled, 0).xyz;
        bool alike = sampleDepth > 0.0 && dot(n, m) >= push.p.leastCosine && abs(dot(y - x, n)) <= reach;
        float w = ((i & 1) == 1 ? f.x : 1.0 - f.x) * ((i >> 1) == 1 ? f.y : 1.0 - f.y);
        if (alike) {
            sum += w * texelFetch(coarse, cell, 0).rgb;
            weights += w;
            accepted += 1;
        }
    }
    bool blended = accepted >= 3 && weights > 0.05;
    imageStore(irradiance, pixel, vec4(blended && depth > 0.0 ? sum / weights : vec3(0.0), 1.0));
    if (!blended && depth > 0.0) listPixel(pixel);
}
