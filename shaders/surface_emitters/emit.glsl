// What points on surfaces reflect of the light that fell on them a frame ago, and what others shine with by themselves:
// emitters like an RSM's texels.
#define AG_SCENE_INSTANCES
#include "common/texels.glsl"
#include "later_bounces/later_bounces_io.h"
#include "rsm/rsm_io.h"
#include "scene/scene.glsl"
#include "surface_points/place_edge.glsl"
#ifdef AG_SKINNED
#include "surface_points/skinned_sample.glsl"
#endif

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { EmitPush p; } push;

layout(set = 0, binding = 1, scalar) readonly buffer Points { BouncePoint items[]; } points;
layout(set = 0, binding = 2) VEC4_TEXELS(irradiance);  // W/m²; a: share that area lights and the sky sent
layout(set = 0, binding = 3, scalar) writeonly buffer Texels { RsmTexel items[]; } texels;
layout(set = 0, binding = 4, scalar) writeonly buffer Edges { SurfaceEdge items[]; } edges;  // two a point
#ifdef AG_SKINNED
layout(set = 0, binding = 5, scalar) readonly buffer Positions { vec3 items[]; } deformedPositions;
layout(set = 0, binding = 6, scalar) readonly buffer Attributes { VertexRow items[]; } deformedAttributes;

// The point as its skinned mesh is bent now.
void followSkinnedMesh(inout BouncePoint p) {
    uvec4 corners = uvec4(floatBitsToUint(p.normalLocal), floatBitsToUint(p.edgesLocal[0].inward.x));
    SurfaceSample s = AG_DEFORMED_SAMPLE(deformedPositions, deformedAttributes, p.instance, p.positionLocal, corners);
    p.positionLocal = s.positionLocal;
    p.normalLocal = s.normalLocal;
    p.edgesLocal = s.edgesLocal;
}
#endif

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.p.count) return;
    BouncePoint p = points.items[push.p.firstPoint + i];
    InstanceTransform t = fetchInstance(int(p.instance));
#ifdef AG_SKINNED
    if (t.skinnedMesh != kNoSkinnedMesh) followSkinnedMesh(p);
#endif
    bool reflects = i < push.p.reflecting;
    vec4 e = reflects && push.p.known == 1 ? fetchTexel(irradiance, int(i)) : vec4(0.0);
    vec3 radiosity = reflects ? min(p.albedo, vec3(kMostAlbedo)) * e.rgb : p.albedo * kPi;
    vec3 flux = radiosity * p.area;
    texels.items[i] = RsmTexel(transformPoint(t, p.positionLocal), p.area, normalize(transformNormal(t, p.normalLocal)),
                               (flux.x + flux.y + flux.z) / 3.0, flux, e.a);
    for (int k = 0; k < 2; ++k) edges.items[i * 2 + k] = placeEdge(t, p.edgesLocal[k]);
}
