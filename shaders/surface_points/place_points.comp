#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Samples of the surfaces to where their instances are this frame.
#define AG_SCENE_INSTANCES
#include "scene/scene.glsl"
#include "surface_points/surface_points_io.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { uint count; } push;

layout(set = 0, binding = 1) uniform samplerBuffer samples;
layout(set = 0, binding = 2, scalar) writeonly buffer Points { SurfacePoint items[]; } points;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    vec4 a = texelFetch(samples, int(i) * 2);
    vec3 n = texelFetch(samples, int(i) * 2 + 1).xyz;
    InstanceTransform t = fetchInstance(int(floatBitsToUint(a.w)));
    points.items[i] = SurfacePoint(transformPoint(t, a.xyz), 0.0, normalize(transformNormal(t, n)), 0.0);
}
