#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The paraboloids' distances in the form of imperfect shadow maps without planes: squares across the ray, somewhat behind.
#include "common/sampling.h"
#include "published/ssvp/ssvp_io.h"

layout(local_size_x = 256) in;
layout(push_constant, scalar) uniform Push { uint mapSize; } push;

layout(set = 0, binding = 0) uniform sampler2D positions;
layout(set = 0, binding = 1, scalar) readonly buffer Clusters { SsvpCluster items[]; } clusters;
layout(set = 0, binding = 2, scalar) writeonly buffer Planes { vec4 items[]; } planes;

const float kBias = 4.0;  // texels

void main() {
    uint map = gl_WorkGroupID.y, texel = gl_GlobalInvocationID.x;  // maps are whole workgroups
    uvec2 origin = uvec2(map % kSsvpMapColumns, map / kSsvpMapColumns) * push.mapSize;
    vec4 hit = texelFetch(positions, ivec2(origin + uvec2(texel % push.mapSize, texel / push.mapSize)), 0);
    SsvpCluster c = clusters.items[map];
    vec3 d = hit.xyz - c.position, x, y;
    orthonormalBasis(c.normal, x, y);
    vec3 p = vec3(dot(d, x), dot(d, y), dot(d, c.normal)) * (1.0 + kBias / float(push.mapSize));
    planes.items[map * push.mapSize * push.mapSize + texel] = hit.w > 0.0 ? vec4(p / max(dot(p, p), 1e-12), length(p)) : vec4(0.0);
}
