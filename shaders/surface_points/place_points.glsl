// Samples of the surfaces to where their instances are this frame.
#define AG_SCENE_INSTANCES
#include "common/texels.glsl"
#include "scene/scene.glsl"
#include "surface_points/place_edge.glsl"
#ifdef AG_SKINNED
#include "surface_points/skinned_sample.glsl"
#endif

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { PointPush p; } push;

layout(set = 0, binding = 1) VEC4_TEXELS(samples);
layout(set = 0, binding = 5) FLOAT_TEXELS(areas);
layout(set = 0, binding = 2, scalar) writeonly buffer Points { SurfacePoint items[]; } points;
#ifdef AG_SKINNED
layout(set = 0, binding = 3, scalar) readonly buffer Positions { vec3 items[]; } deformedPositions;
layout(set = 0, binding = 4, scalar) readonly buffer Attributes { VertexRow items[]; } deformedAttributes;
#endif

SurfaceSample fetchSample(int i) {
    vec4 a = fetchTexel(samples, i * 4), n = fetchTexel(samples, i * 4 + 1);
    SurfaceSample s;
    s.positionLocal = a.xyz;
    s.instance = floatBitsToUint(a.w);
    s.normalLocal = n.xyz;
    s.curvatureLocal = n.w;
    for (int k = 0; k < 2; ++k) s.edgesLocal[k] = edgeOf(fetchTexel(samples, i * 4 + 2 + k));
    return s;
}

void main() {
    uint i = push.p.firstGroup * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
    if (i >= push.p.pointCount) return;
    SurfaceSample s = fetchSample(int(i));
    if (s.instance == kNoInstance) {
        SurfaceEdge cutOut = SurfaceEdge(vec3(0.0), -1.0);
        points.items[i] = SurfacePoint(vec3(0.0), 0.0, vec3(0.0, 0.0, 1.0), 0.0, SurfaceEdge[2](cutOut, cutOut));
        return;
    }
    InstanceTransform t = fetchInstance(int(s.instance));
#ifdef AG_SKINNED
    if (t.skinnedMesh != kNoSkinnedMesh)
        s = AG_DEFORMED_SAMPLE(deformedPositions, deformedAttributes, s.instance, s.positionLocal,
                               floatBitsToUint(vec4(s.normalLocal, s.curvatureLocal)));
#endif
    SurfacePoint p;
    p.position = transformPoint(t, s.positionLocal);
    p.normal = normalize(transformNormal(t, s.normalLocal));
    p.curvature = s.curvatureLocal / max(length(transformDirection(t, s.normalLocal)), 1e-20);
    p.radius = sqrt(fetchTexel(areas, int(s.instance)).x / kPi);
    for (int k = 0; k < 2; ++k) p.edges[k] = placeEdge(t, s.edgesLocal[k]);
    points.items[i] = p;
}
