#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// K-means over the lit lights, from the centres of the frame before (SSVP section III-B). Its eq. 2 adds the cosine of the
// normals and so pushes like ones apart; here what is lacking from it counts.
#include "common/sampling.h"
#include "published/ssvp/ssvp_io.h"
#include "val_fit/val_fit_io.h"

layout(local_size_x = 256) in;  // one workgroup
layout(push_constant, scalar) uniform Push { uint vplCount, clusterCount, rounds, known; } push;

layout(set = 0, binding = 0, scalar) readonly buffer Vpls { Val items[]; } vpls;
layout(set = 0, binding = 1, scalar) readonly buffer Before { SsvpCluster items[]; } before;
layout(set = 0, binding = 2, scalar) writeonly buffer Clusters { SsvpCluster items[]; } clusters;
layout(set = 0, binding = 3, scalar) writeonly buffer Owners { uint items[]; } owners;

const float kDistanceWeight = 0.6;  // 1/m
const float kNormalWeight = 0.4;

shared vec3 centers[kMostSsvpClusters];
shared vec3 normals[kMostSsvpClusters];
shared uint ownerOf[kMostSsvpVpls];

bool lit(Val v) { return v.flux != vec3(0.0); }

void assign(uint thread) {
    for (uint i = thread; i < push.vplCount; i += gl_WorkGroupSize.x) {
        Val v = vpls.items[i];
        float least = 3.0e38;
        uint nearest = 0;
        for (uint c = 0; c < push.clusterCount; ++c) {
            float d = kDistanceWeight * distance(v.position, centers[c]) + kNormalWeight * (1.0 - dot(v.normal, normals[c]));
            nearest = d < least ? c : nearest;
            least = min(least, d);
        }
        ownerOf[i] = lit(v) ? nearest : kMostSsvpClusters;
    }
}

SsvpCluster sumOf(uint c) {
    SsvpCluster sum = SsvpCluster(vec3(0.0), 0, vec3(0.0), 0, vec3(0.0), 0);
    for (uint i = 0; i < push.vplCount; ++i) {
        if (ownerOf[i] != c) continue;
        Val v = vpls.items[i];
        sum.position += v.position;
        sum.normal += v.normal;
        sum.flux += v.flux;
        ++sum.vplCount;
    }
    bool any = sum.vplCount > 0 && dot(sum.normal, sum.normal) > 1e-6;
    sum.position = any ? sum.position / float(sum.vplCount) : centers[c];
    sum.normal = any ? normalize(sum.normal) : normals[c];
    return sum;
}

void main() {
    uint thread = gl_LocalInvocationID.x;
    SsvpCluster mine;
    if (thread < push.clusterCount) {
        Val start = vpls.items[hashUint(thread) % push.vplCount];
        centers[thread] = push.known != 0 ? before.items[thread].position : start.position;
        normals[thread] = push.known != 0 ? before.items[thread].normal : start.normal;
    }
    barrier();
    for (uint round = 0; round < push.rounds; ++round) {
        assign(thread);
        barrier();
        if (thread < push.clusterCount) mine = sumOf(thread);
        barrier();
        if (thread < push.clusterCount) {
            centers[thread] = mine.position;
            normals[thread] = mine.normal;
        }
        barrier();
    }
    if (thread < push.clusterCount) clusters.items[thread] = mine;
    for (uint i = thread; i < push.vplCount; i += gl_WorkGroupSize.x) owners.items[i] = ownerOf[i];
}
