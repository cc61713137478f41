// How much of a cluster's light arrives, by its centre's depth maps: as from the centre, or as from a disk about it. Needs
// sampler `shadowAtlas` and texel buffer `clusters`.
#ifndef AG_PUNCTUAL_SHADOW_GLSL
#define AG_PUNCTUAL_SHADOW_GLSL

#include "common/lights.h"
#include "direct_lighting/direct_lighting_io.h"
#include "direct_lighting/shadow_lookup.glsl"

layout(constant_id = 1) const int kSoftTaps = 0;  // of a disk as large as the cluster (PCSS); 0: a point
const float kMostSpread = 4.0;

// Taps of a disk that are spread evenly for any count (Vogel).
vec2 diskTap(int i, int count) {
    float r = sqrt((float(i) + 0.5) / float(count)), angle = 2.3999632 * float(i);
    return r * vec2(cos(angle), sin(angle));
}

LightClusterRow fetchCluster(uint index) {
    vec4 a = fetchTexel(clusters, int(index) * 4), b = fetchTexel(clusters, int(index) * 4 + 1);
    vec4 c = fetchTexel(clusters, int(index) * 4 + 2), d = fetchTexel(clusters, int(index) * 4 + 3);
    LightClusterRow cluster;
    cluster.center = a.xyz;
    cluster.radius = a.w;
    cluster.direction = b.xyz;
    cluster.tanHalf = b.w;
    cluster.origin = floatBitsToUint(c.xy);
    cluster.size = floatBitsToUint(c.z);
    cluster.nearDistance = c.w;
    cluster.farDistance = d.x;
    return cluster;
}

struct PunctualView {  // one of a cluster's
    vec3 right, top, forward;
    uvec2 origin;
};

// The view that a direction from the centre lies in. The same axes as light_views.cpp has; made here, because loading
// matrices by an index that differs from pixel to pixel is dear.
PunctualView viewToward(LightClusterRow cluster, vec3 d) {
    PunctualView v;
    bool spot = cluster.direction != vec3(0.0);
    uint face = spot ? 0 : cubeFace(d);
    vec3 axis = vec3(face / 2 == 0, face / 2 == 1, face / 2 == 2) * (face % 2 == 0 ? 1.0 : -1.0);
    v.forward = spot ? cluster.direction : axis;
    v.right = normalize(cross(v.forward, abs(v.forward.y) > 0.99 ? vec3(0.0, 0.0, 1.0) : vec3(0.0, 1.0, 0.0)));
    v.top = cross(v.right, v.forward);
    v.origin = cluster.origin + uvec2(face % 3, face / 3) * cluster.size;
    return v;
}

// Along a ray from the centre: how far the first surface is, over the distance to the receiver's plane; below 1 it is in
// the way. `slack`: m along the view's axis.
float firstHit(LightClusterRow cluster, vec3 receiver, vec3 normal, vec3 along, float slack) {
    float toPlane = dot(normal, receiver), grows = dot(normal, along);
    vec3 p = along * (grows * toPlane > 0.0 ? min(toPlane / grows, 4.0) : 1.0);
    PunctualView view = viewToward(cluster, along);
    float w = max(dot(p, view.forward), 1e-6);
    vec2 ndc = vec2(dot(p, view.right), -dot(p, view.top)) / (w * cluster.tanHalf), size = vec2(float(cluster.size));
    ivec2 at = ivec2(clamp((ndc * 0.5 + 0.5) * size, vec2(0.0), size - 1.0));
    float stored = texelFetch(shadowAtlas, ivec2(view.origin) + at, 0).x;
    // Reversed depth back to the distance along the view's axis; where nothing is, nothing is in the way.
    float near = cluster.nearDistance, far = cluster.farDistance;
    return stored > 0.0 ? (near * far / (stored * (far - near) + near) + slack) / w : 2.0;
}

// Not asked for, it costs two of its rounds: CPU devices skip rounds of loops but not branches.
float softShare(LightClusterRow cluster, vec3 position, vec3 normal, float texel, bool asked) {
    // A texel seen slantwise holds this much depth: the plane is taken so much nearer.
    vec3 d = position + normal * texel - cluster.center;
    vec3 u, v;
    orthonormalBasis(d * inversesqrt(max(dot(d, d), 1e-12)), u, v);
    u *= cluster.radius;
    v *= cluster.radius;
    float blockers = 0.0, share = 0.0;
    const int kSearch = 6;
    int search = asked ? kSearch : 0;
    [[dont_unroll]] for (int i = 0; i < search; ++i) {
        vec2 tap = diskTap(i, kSearch);
        float rho = firstHit(cluster, d, normal, d + u * tap.x + v * tap.y, texel);
        blockers += rho < 1.0 ? 1.0 : 0.0;
        share += rho < 1.0 ? max(rho, 0.05) : 0.0;
    }
    bool partly = blockers > 0.0;
    float rho = partly ? share / blockers : 1.0, spread = min((1.0 - rho) / rho, kMostSpread), lit = 0.0;
    int taps = partly ? kSoftTaps : 0;
    [[dont_unroll]] for (int i = 0; i < taps; ++i) {
        vec2 tap = diskTap(i, kSoftTaps) * spread;
        lit += firstHit(cluster, d, normal, d + u * tap.x + v * tap.y, texel) < 1.0 ? 0.0 : 1.0;
    }
    return partly ? lit / float(kSoftTaps) : 1.0;
}

ShadowMap mapOf(LightClusterRow cluster, PunctualView view) {
    vec3 x = view.right / cluster.tanHalf, y = -view.top / cluster.tanHalf, w = view.forward;
    float depth = cluster.nearDistance / (cluster.farDistance - cluster.nearDistance);
    vec3 z = -depth * w;
    vec4 offset = vec4(-dot(x, cluster.center), -dot(y, cluster.center),
                       -dot(z, cluster.center) + depth * cluster.farDistance, -dot(w, cluster.center));
    mat4 clipFromWorld = mat4(vec4(x.x, y.x, z.x, w.x), vec4(x.y, y.y, z.y, w.y), vec4(x.z, y.z, z.z, w.z), offset);
    return ShadowMap(clipFromWorld, view.origin, cluster.size);
}

float clusterShare(uint index, vec3 position, vec3 normal) {
    LightClusterRow cluster = fetchCluster(index);
    vec3 d = position - cluster.center;
    float distance_ = max(length(d), 1e-4);
    float texel = 2.0 * cluster.tanHalf / float(cluster.size) * distance_;  // m at the receiver
    bool soft = cluster.radius > texel;
    float hard = litShare(mapOf(cluster, viewToward(cluster, d)), texel, position, normal, -d / distance_);
    if (kSoftTaps == 0) return hard;
    float disk = softShare(cluster, position, normal, texel, soft);
    return soft ? disk : hard;
}
#endif
