#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Clusters to virtual area lights: centre, area and flux, and the rectangle that has the cluster's second moments in
// the light's plane (a uniform rectangle's are a third of its half sides squared). Empty clusters and the padding to
// whole subgroups become black lights.
#include "common/sampling.h"
#include "val_clustering/val_clustering_io.h"
#include "val_fit/val_fit_io.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push {
    uint clusterCount;
    uint valCount;  // with padding
} push;

layout(set = 0, binding = 0, scalar) readonly buffer Clusters { Cluster items[]; } clusters;
layout(set = 0, binding = 1, scalar) writeonly buffer Vals { Val items[]; } vals;
layout(set = 0, binding = 2, scalar) writeonly buffer Shapes { ValShapeVectors items[]; } shapes;

ValShapeVectors rectangleOf(Cluster c) {
    vec3 t, b;
    orthonormalBasis(c.normal, t, b);
    mat3 moments = mat3(c.covarianceDiagonal.x, c.covarianceMixed.x, c.covarianceMixed.y,
                        c.covarianceMixed.x, c.covarianceDiagonal.y, c.covarianceMixed.z,
                        c.covarianceMixed.y, c.covarianceMixed.z, c.covarianceDiagonal.z);
    float tt = dot(t, moments * t), bb = dot(b, moments * b), tb = dot(t, moments * b);
    float middle = 0.5 * (tt + bb), half_ = 0.5 * (tt - bb);
    float spread = sqrt(half_ * half_ + tb * tb);
    // Half the angle of (half_, tb): the direction of the larger moment.
    float cosine = spread > 1e-12 ? sqrt(max(0.5 * (1.0 + half_ / spread), 0.0)) : 1.0;
    float sine = sqrt(max(1.0 - cosine * cosine, 0.0)) * (tb < 0.0 ? -1.0 : 1.0);
    vec3 axis = t * cosine + b * sine, across = cross(c.normal, axis);
    // A single texel has no moments: then, and for slivers, a share of the cluster's own size.
    float least = 0.05 * sqrt(c.area);
    float u = max(sqrt(max(3.0 * (middle + spread), 0.0)), least);
    float v = max(sqrt(max(3.0 * (middle - spread), 0.0)), least);
    return ValShapeVectors(axis * u, 0.25 / (u * v), across * v, 0.0);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.valCount) return;
    Val val = Val(vec3(0.0), 1.0, vec3(0.0, 1.0, 0.0), 0.0, vec3(0.0), 0.0);
    ValShapeVectors shape = ValShapeVectors(vec3(0.5, 0.0, 0.0), 1.0, vec3(0.0, 0.0, 0.5), 0.0);
    if (i < push.clusterCount) {
        Cluster c = clusters.items[i];
        if (c.texelCount > 0.0) {
            val = Val(c.position, c.area, c.normal, sqrt(c.area * 0.31830989), c.flux, c.texelCount);
            shape = rectangleOf(c);
        }
    }
    vals.items[i] = val;
    shapes.items[i] = shape;
}
