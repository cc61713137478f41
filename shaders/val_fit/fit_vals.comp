#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Clusters to virtual area lights: a disk of the cluster's area about its centre. Empty clusters and the padding to
// whole subgroups become black lights.
#include "val_clustering/val_clustering_io.h"
#include "val_fit/val_fit_io.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push {
    uint clusterCount;
    uint valCount;  // with padding
} push;

layout(set = 0, binding = 0, scalar) readonly buffer Clusters { Cluster items[]; } clusters;
layout(set = 0, binding = 1, scalar) writeonly buffer Vals { Val items[]; } vals;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.valCount) return;
    Val val = Val(vec3(0.0), 1.0, vec3(0.0, 1.0, 0.0), 0.0, vec3(0.0), 0.0);
    if (i < push.clusterCount) {
        Cluster c = clusters.items[i];
        if (c.texelCount > 0.0)
            val = Val(c.position, c.area, c.normal, sqrt(c.area * 0.31830989), c.flux, c.texelCount);
    }
    vals.items[i] = val;
}
