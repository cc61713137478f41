#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Virtual area lights drawn as the polygons they are: a surface point inside one takes its flux's hue in a shade of its
// own, the rim dark; the rest of the scene in grey.
#include "common/sampling.h"
#include "common/texels.glsl"
#include "gbuffer/gbuffer.glsl"
#include "val_fit/val_fit_io.h"

layout(push_constant) uniform Push { uint valCount; } push;
layout(set = 0, binding = 0) VEC4_TEXELS(vals);
layout(set = 0, binding = 1) VEC4_TEXELS(shapes);
layout(set = 0, binding = 2) uniform sampler2D depthMap;
layout(set = 0, binding = 3) uniform sampler2D normalMap;
layout(set = 0, binding = 4, scalar) uniform Camera { CameraConstants camera; } camera;

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;

vec2 cornerOf(uint light, uint i) {
    vec4 two = fetchTexel(shapes, int(light * kValShapeVec4s + 2 + i / 2));
    return i % 2 == 0 ? two.xy : two.zw;
}

// How far inside the polygon p is, m; below 0 outside.
float depthInside(uint light, vec2 p) {
    float least = 3.0e38;
    for (uint i = 0; i < kValCorners; ++i) {
        vec2 a = cornerOf(light, i), edge = cornerOf(light, (i + 1) % kValCorners) - a;
        float extent = length(edge);
        if (extent > 1e-6) least = min(least, (edge.x * (p.y - a.y) - edge.y * (p.x - a.x)) / extent);
    }
    return least;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depthMap, pixel, 0).x;
    vec3 position = worldFromPixel(camera.camera.worldFromClip, camera.camera.size, pixel, depth);
    vec3 normal = texelFetch(normalMap, pixel, 0).xyz;
    vec3 toEye = normalize(camera.camera.position - position);
    vec3 base = vec3(0.1);
    float deepest = 0.0;  // polygons overlap a little: the one whose rim is farthest wins
    for (uint i = 0; i < push.valCount; ++i) {
        vec4 place = fetchTexel(vals, int(i) * 3);
        vec3 n = fetchTexel(vals, int(i) * 3 + 1).xyz;
        vec3 flux = fetchTexel(vals, int(i) * 3 + 2).xyz;
        if (flux == vec3(0.0)) continue;
        vec3 t, b, d = position - place.xyz;
        orthonormalBasis(n, t, b);
        float radius = sqrt(place.w * kInvPi);  // of the disk of its area
        float inside = depthInside(i, vec2(dot(d, t), dot(d, b)));
        bool on = inside > deepest && abs(dot(d, n)) < 0.2 * radius && dot(n, normal) > 0.5;
        if (!on) continue;
        deepest = inside;
        vec3 hue = flux / max(max(flux.x, max(flux.y, flux.z)), 1e-30);
        base = inside < 0.06 * radius ? vec3(0.02) : hue * (0.5 + 0.5 * hashToUnit(i));
    }
    float shade = depth > 0.0 ? 0.3 + 0.7 * max(dot(normal, toEye), 0.0) : 0.0;
    color = vec4(base * shade, 1.0);
}
