#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The static layer of listed maps, a ray a texel: the plane of the nearest surface there.
#include "common/texels.glsl"
#include "ism_atlas/ism_atlas_io.h"
#include "ism_atlas/ism_light.glsl"
#include "ism_atlas/ism_map.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { IsmSplatPush p; } push;

layout(set = 0, binding = 0) VEC4_TEXELS(vals);
layout(set = 0, binding = 1, scalar) readonly buffer Listed { uint items[]; } listed;
layout(set = 0, binding = 2) UVEC4_TEXELS(treeNodes);
layout(set = 0, binding = 3, scalar) readonly buffer TreeTriangles { vec4 items[]; } treeTriangles;
layout(set = 0, binding = 4) UVEC4_TEXELS(treePlaces);
layout(set = 0, binding = 5, scalar) writeonly buffer Planes { vec4 items[]; } planes;

#include "bvh/trace.glsl"

const uint kBlock = 8;       // texels along what a workgroup traces

vec3 toWorld(IsmLight l, vec3 v) { return l.t * v.x + l.b * v.y + l.normal * v.z; }

void main() {
    uint size = push.p.tileSize, map = listed.items[gl_WorkGroupID.y], along = size / kBlock, i = gl_LocalInvocationID.x;
    uvec2 at = uvec2(gl_WorkGroupID.x % along, gl_WorkGroupID.x / along) * kBlock + uvec2(i % kBlock, i / kBlock);
    uint texel = (map * size + at.y) * size + at.x;
    IsmLight light = AG_ISM_LIGHT(vals, map);
    vec3 direction = toWorld(light, ismDirection((vec2(at) + 0.5) / float(size)));
    float extent = 1.0 / push.p.inverseExtent, offset = kBvhOffset * extent;
    BvhRay ray = BvhRay(light.place + light.normal * offset, direction, 2.0 * extent, hashToUnit(texel), false, -1, 0);
    traceTree(ray, kBvhStatic);
    vec4 plane = vec4(0.0);
    if (ray.triangle >= 0) {
        vec3 p = toLight(light, direction) * ray.reach + vec3(0.0, 0.0, offset);
        plane = vec4(planeThrough(p, normalize(toLight(light, triangleNormal(ray.triangle, kBvhStatic)))), length(p));
    }
    planes.items[texel] = plane;
}
