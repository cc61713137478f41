#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Takes what rays over the picture found into the picture, in place of as much of the lobe by area lights; before,
// pixels that reflect alike share their rays.
#include "common/brdf.h"
#include "reflections/reflections_io.h"

layout(constant_id = 0) const bool kIndirect = true;  // compiled out where there is none
layout(constant_id = 1) const bool kGloss = true;

layout(push_constant, scalar) uniform Push { ReflectionsMixPush p; } push;
layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2) uniform sampler2D reflectanceMap;
layout(set = 0, binding = 3) uniform sampler2D radianceMap;
layout(set = 0, binding = 4) uniform sampler2D foundMap;  // written where lobes are narrow
layout(set = 0, binding = 5) uniform sampler2D albedoMap;
layout(set = 0, binding = 6) uniform sampler2D indirectMap;
layout(set = 0, binding = 7) uniform sampler2D glossMap;

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 radiance;  // W/(m² sr)

const int kReach = 2;  // pixels to each side

bool isSmooth(ivec2 pixel, float roughness) {
    return roughness < push.p.roughness && texelFetch(depthMap, pixel, 0).x > 0.0 && texelFetch(reflectanceMap, pixel, 0).w > 0.0;
}

// What pixels about this one found, as far as the lobe spreads over them and they reflect alike.
vec4 foundAbout(ivec2 pixel, vec4 normal) {
    vec4 sum = texelFetch(foundMap, pixel, 0);
    float weight = 1.0, alpha = normal.w * normal.w, spread = min(2.0 * alpha / push.p.pixelAngle, float(kReach));
    ivec2 last = textureSize(depthMap, 0) - 1;
    for (int y = -kReach; y <= kReach; ++y)
        for (int x = -kReach; x <= kReach; ++x) {
            ivec2 there = clamp(pixel + ivec2(x, y), ivec2(0), last);
            vec4 other = texelFetch(normalMap, there, 0);
            vec3 turn = other.xyz - normal.xyz;
            float far = float(x * x + y * y) / max(spread * spread, 1e-6), like = exp(-far - 2.0 * dot(turn, turn) / max(alpha * alpha, 1e-6));
            bool takes = (x != 0 || y != 0) && like > 0.01 && abs(other.w - normal.w) < 0.02 && isSmooth(there, other.w);
            if (!takes) continue;
            sum += like * texelFetch(foundMap, there, 0);
            weight += like;
        }
    return sum / weight;
}

// What area lights put into the lobe; their gloss is less what the lobe keeps from what is under it.
vec3 lobeOfLights(ivec2 pixel, vec3 normal) {
    if (!kGloss) return vec3(0.0);
    vec3 toViewer = -normalize(placeOf(push.p.rays, vec2(pixel), 1.0));
    vec4 reflectance = texelFetch(reflectanceMap, pixel, 0);
    vec3 kept = meanFresnel(reflectance.rgb, vec3(reflectance.w), dot(normal, toViewer));
    vec3 irradiance = kIndirect ? texelFetch(indirectMap, pixel, 0).rgb : vec3(0.0);
    vec3 under = texelFetch(albedoMap, pixel, 0).rgb * irradiance * kInvPi;
    return max(texelFetch(glossMap, pixel, 0).rgb + kept * under, vec3(0.0));
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    radiance = texelFetch(radianceMap, pixel, 0);
    vec4 normal = texelFetch(normalMap, pixel, 0);
    if (!isSmooth(pixel, normal.w)) return;
    vec4 found = foundAbout(pixel, normal);
    vec3 change = found.rgb - found.w * lobeOfLights(pixel, normal.xyz);
    radiance.rgb = clamp(radiance.rgb + smoothShare(normal.w, push.p.roughness) * change, vec3(0.0), vec3(kMostHalf));
}
