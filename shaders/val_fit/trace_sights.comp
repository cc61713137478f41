#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// For hosts that have trees of their occluders: which of a cluster's texels, the nearest and the extremes, see the middle of
// them all, and the place just before them that the light looks out from. A ray an invocation.
#include "common/sampling.h"
#include "common/texels.glsl"
#include "rsm/rsm.glsl"
#include "val_clustering/val_clustering_io.h"
#include "val_fit/val_fit_io.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { ValFitPush p; } push;

layout(set = 0, binding = 0, scalar) readonly buffer Clusters { Cluster items[]; } clusters;
layout(set = 0, binding = 1, scalar) readonly buffer Extents { ClusterExtent items[]; } extents;
layout(set = 0, binding = 2) VEC4_TEXELS(texels);
layout(set = 0, binding = 3) UVEC4_TEXELS(treeNodes);
layout(set = 0, binding = 4, scalar) readonly buffer TreeTriangles { vec4 items[]; } treeTriangles;
layout(set = 0, binding = 5) UVEC4_TEXELS(treePlaces);
layout(set = 0, binding = 6, scalar) writeonly buffer Sights { uint items[]; } sights;

#include "bvh/trace.glsl"

bool sees(uint texel, vec3 place) {
    RsmSurface s = AG_RSM_FETCH(texels, texel);
    vec3 start = s.position + s.normal * push.p.offset;
    BvhRay ray = BvhRay(start, place - start, 1.0, hashToUnit(texel), true, -1, 0);
    traceTree(ray, kBvhStatic);
    return ray.triangle < 0;
}

void main() {
    uint i = gl_GlobalInvocationID.x, light = i / (kSightPlaces * kSightTexels);
    if (light >= push.p.clusterCount) return;
    Cluster c = clusters.items[light];
    if (c.texelCount == 0.0) return;
    ClusterExtent extent = extents.items[light];
    uint texel = i % kSightTexels;
    bool ofPlace = i / kSightTexels % kSightPlaces == kSightOfPlace;
    vec3 place = c.position + (ofPlace ? c.normal * (extent.before + push.p.offset) : vec3(0.0));
    sights.items[i] = uint(sees(texel == 0 ? extent.nearest : extent.texels[texel - 1], place));
}
