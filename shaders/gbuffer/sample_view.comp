#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Halton-chosen surface points of the camera's view (RSMC section 4, view-dependent importance).
#include "common/sampling.h"
#include "gbuffer/view_points_io.h"
#include "scene/scene_io.h"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2, scalar) uniform Camera { CameraConstants camera; } camera;
layout(set = 0, binding = 3, scalar) writeonly buffer ViewPoints { ViewPoint items[]; } viewPoints;

void main() {
    CameraConstants view = camera.camera;
    vec2 uv = halton23(gl_GlobalInvocationID.x + 1);
    ivec2 pixel = ivec2(uv * vec2(view.size));
    float depth = texelFetch(depthMap, pixel, 0).x;
    vec2 ndc = (vec2(pixel) + 0.5) / vec2(view.size) * 2.0 - 1.0;
    vec4 h = view.worldFromClip * vec4(ndc, max(depth, 1e-7), 1.0);
    vec3 normal = texelFetch(normalMap, pixel, 0).xyz;
    viewPoints.items[gl_GlobalInvocationID.x] =
        ViewPoint(h.xyz / h.w, depth > 0.0 ? 1.0 : 0.0, normal, depth);
}
