// How a cluster's flux is spread about its centre.
#ifndef AG_COVARIANCE_GLSL
#define AG_COVARIANCE_GLSL

#include "val_clustering/val_clustering_io.h"

// m²; u . covariance v is that of the places along u and v.
mat3 covarianceOf(Cluster c) {
    vec3 own = c.covarianceDiagonal, mixed = c.covarianceMixed;  // mixed: xy, xz, yz
    return mat3(own.x, mixed.x, mixed.y, mixed.x, own.y, mixed.z, mixed.y, mixed.z, own.z);
}
#endif
