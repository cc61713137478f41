#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// What error each cluster makes by standing for its texels as one light: of its flux, as far as it faces the view, and
// of the irradiance at points of the view. A texel off the centre by s is seen from another direction at distances like
// s; one of another normal sends its light elsewhere at any distance.
#include "common/lanes.glsl"
#include "common/sampling.h"
#include "common/texels.glsl"
#include "importance/importance_io.h"
#include "val_clustering/covariance.glsl"
#include "val_clustering/val_clustering_io.h"

layout(constant_id = 0) const bool kFromView = false;
layout(push_constant, scalar) uniform Push { ClusterSettings settings; } push;

layout(set = 0, binding = 0, scalar) readonly buffer Previous { Cluster items[]; } previous;
layout(set = 0, binding = 1) VEC4_TEXELS(viewPoints);
layout(set = 0, binding = 2, scalar) writeonly buffer Errors { ClusterError items[]; } errors;

float sum3(vec3 v) { return v.x + v.y + v.z; }

// How much cluster and point of the view face each other (ACRSM section 4.4), and the irradiance wrongly sent there over
// the cluster's flux.
vec2 viewedFrom(Cluster c, vec4 place, vec3 normal) {
    vec3 d = place.xyz - c.position;
    float d2 = max(dot(d, d), 1e-8), s2 = sum3(c.covarianceDiagonal);
    float facing = place.w * max(dot(d, c.normal), 0.0) * max(-dot(d, normal), 0.0) / d2;
    float irradiance = facing * kInvPi / (d2 + c.area * kInvPi);
    return vec2(facing, irradiance * (s2 / (d2 + s2) + 1.0 - c.cosineSpread));
}

vec2 meanOverView(Cluster c) {
    vec2 sum = vec2(0.0);
    for (uint i = laneIndex(); i < kViewPointCount; i += kLanes)
        sum += viewedFrom(c, fetchTexel(viewPoints, int(i) * 2), fetchTexel(viewPoints, int(i) * 2 + 1).xyz);
    return laneAdd(sum) / float(kViewPointCount);
}

void main() {
    uint cluster = gl_WorkGroupID.x;
    Cluster c = previous.items[cluster];
    vec2 view = kFromView ? meanOverView(c) : vec2(1.0, 0.0);
    vec4 weights = push.settings.metricWeights;
    float metric = weights.x * sum3(c.covarianceDiagonal) + weights.y * (1.0 - c.cosineSpread) +
                   weights.w * dot(c.normal, covarianceOf(c) * c.normal);
    if (laneIndex() == 0)
        errors.items[cluster] = ClusterError(sum3(c.flux) * view.x * metric, sum3(c.flux) * view.y);
}
