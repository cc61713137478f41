#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// What the points reflect of the light that fell on them a frame ago: emitters like a light map's texels.
#define AG_SCENE_INSTANCES
#include "later_bounces/later_bounces_io.h"
#include "rsm/rsm_io.h"
#include "scene/scene.glsl"
#include "surface_points/place_edge.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { EmitPush p; } push;

layout(set = 0, binding = 1, scalar) readonly buffer Points { BouncePoint items[]; } points;
layout(set = 0, binding = 2) uniform samplerBuffer irradiance;  // W/m²
layout(set = 0, binding = 3, scalar) writeonly buffer Texels { RsmTexel items[]; } texels;
layout(set = 0, binding = 4, scalar) writeonly buffer Edges { SurfaceEdge items[]; } edges;  // two a point

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.p.count) return;
    BouncePoint p = points.items[i];
    InstanceTransform t = fetchInstance(int(p.instance));
    vec3 e = push.p.known == 1 ? texelFetch(irradiance, int(i)).rgb : vec3(0.0);
    vec3 flux = min(p.albedo, vec3(kMostAlbedo)) * e * p.area;
    texels.items[i] = RsmTexel(transformPoint(t, p.positionLocal), p.area, normalize(transformNormal(t, p.normalLocal)),
                               (flux.x + flux.y + flux.z) / 3.0, flux, 1.0);
    for (int k = 0; k < 2; ++k) edges.items[i * 2 + k] = placeEdge(t, p.edgesLocal[k]);
}
