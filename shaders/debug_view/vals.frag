#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Virtual area lights drawn as the disks they are: a surface point inside a light's disk takes its flux's hue, the rim
// dark; the rest of the scene in grey.
#include "gbuffer/gbuffer.glsl"
#include "val_fit/val_fit_io.h"

layout(push_constant) uniform Push { uint valCount; } push;
layout(set = 0, binding = 0) uniform samplerBuffer vals;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2) uniform sampler2D normalMap;
layout(set = 0, binding = 3, scalar) readonly buffer Camera { CameraConstants camera; } camera;

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depthMap, pixel, 0).x;
    vec3 position = worldFromPixel(camera.camera.worldFromClip, camera.camera.size, pixel, depth);
    vec3 normal = texelFetch(normalMap, pixel, 0).xyz;
    vec3 toEye = normalize(camera.camera.position - position);
    vec3 base = vec3(0.1);
    float nearest = 1.0;  // relative distance from a light's centre: disks overlap, the nearest centre wins
    for (uint i = 0; i < push.valCount; ++i) {
        vec4 a = texelFetch(vals, int(i) * 3);
        vec4 n = texelFetch(vals, int(i) * 3 + 1);
        vec3 flux = texelFetch(vals, int(i) * 3 + 2).xyz;
        vec3 d = position - a.xyz;
        float relative = length(d) / max(n.w, 1e-6);
        bool inside = relative < nearest && abs(dot(d, n.xyz)) < 0.2 * n.w && dot(n.xyz, normal) > 0.5;
        nearest = inside ? relative : nearest;
        vec3 hue = flux / max(max(flux.x, max(flux.y, flux.z)), 1e-30);
        base = inside ? (relative > 0.85 ? vec3(0.02) : hue) : base;
    }
    float shade = depth > 0.0 ? 0.3 + 0.7 * max(dot(normal, toEye), 0.0) : 0.0;
    color = vec4(base * shade, 1.0);
}
