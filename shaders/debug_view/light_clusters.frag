#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Punctual lights in the colours of the clusters whose shadow map they share: surfaces by the one they have most light
// of, and the lights themselves as dots, each cluster's centre as a large one.
#include "common/false_color.h"
#include "common/texels.glsl"
#include "gbuffer/gbuffer.glsl"

layout(push_constant, scalar) uniform Push { uint lightCount; } push;
layout(set = 0, binding = 0) VEC4_TEXELS(lights);
#include "direct_lighting/punctual_light.glsl"
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2) uniform sampler2D normalMap;
layout(set = 0, binding = 3, scalar) uniform Camera { CameraConstants camera; } camera;

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;

vec3 colorOf(PunctualLight light) { return light.cluster == kNoLightCluster ? vec3(0.6) : hueFromIndex(light.cluster); }

void main() {
    uvec2 size = camera.camera.size;
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depthMap, pixel, 0).x;
    vec3 position = worldFromPixel(camera.camera.worldFromClip, size, pixel, depth);
    vec3 normal = texelFetch(normalMap, pixel, 0).xyz;
    vec3 surface = vec3(0.05), dot_ = vec3(0.0);
    float most = 0.0, nearest = 0.0;  // reversed depth
    for (uint i = 0; i < push.lightCount; ++i) {
        PunctualLight light = punctualLightAt(i);
        float distance2;
        vec3 e = irradianceFrom(light, position, normal, distance2);
        float sum = e.r + e.g + e.b;
        surface = sum > most ? colorOf(light) : surface;
        most = max(most, sum);
        vec4 clip = camera.camera.clipFromWorld * vec4(light.position, 1.0);
        vec3 ndc = clip.xyz / clip.w;
        float radius = light.clusterDistance > 0.0 || light.cluster == kNoLightCluster ? 2.0 : 4.0;
        vec2 apart = (ndc.xy * 0.5 + 0.5) * vec2(size) - gl_FragCoord.xy;
        bool shown = clip.w > 0.0 && ndc.z > max(depth, nearest) && dot(apart, apart) < radius * radius;
        dot_ = shown ? colorOf(light) : dot_;
        nearest = shown ? ndc.z : nearest;
    }
    vec3 toEye = normalize(camera.camera.position - position);
    float shade = depth > 0.0 ? 0.1 + 0.4 * max(dot(normal, toEye), 0.0) : 0.0;
    color = vec4(nearest > 0.0 ? dot_ : surface * shade, 1.0);
}
