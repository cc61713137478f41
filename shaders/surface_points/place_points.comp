#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Samples of the surfaces to where their instances are this frame.
#define AG_SCENE_INSTANCES
#include "scene/scene.glsl"
#include "surface_points/place_edge.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { uint count; } push;

layout(set = 0, binding = 1) uniform samplerBuffer samples;
layout(set = 0, binding = 2, scalar) writeonly buffer Points { SurfacePoint items[]; } points;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    vec4 a = texelFetch(samples, int(i) * 4);
    vec4 n = texelFetch(samples, int(i) * 4 + 1);
    InstanceTransform t = fetchInstance(int(floatBitsToUint(a.w)));
    SurfacePoint p;
    p.position = transformPoint(t, a.xyz);
    p.normal = normalize(transformNormal(t, n.xyz));
    p.bend = n.w / max(length(transformDirection(t, n.xyz)), 1e-20);
    p.unused = 0.0;
    for (int k = 0; k < 2; ++k) p.edges[k] = placeEdge(t, edgeOf(texelFetch(samples, int(i) * 4 + 2 + k)));
    points.items[i] = p;
}
