#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// All lights of the frame: those of the first bounce, shadowed by their cluster's map, then those of the second, which are
// places of the clusters' maps under a Hammersley set on the paraboloid's disk (SSVP section III-C), or on the square
// round it for comparison. The source weighs all alike; here each carries what falls on its share of the map: flux times
// cosine / pi times its solid angle, which is 4 / (1 + p²)² times its share of the disk, p from the middle.
#include "common/sampling.h"
#include "published/ssvp/ssvp_io.h"
#include "val_fit/val_fit_io.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { uint firstCount, secondCount, valCount, clusterCount, mapSize; } push;
layout(constant_id = 0) const bool kDisk = true;

layout(set = 0, binding = 0, scalar) readonly buffer First { Val items[]; } first;
layout(set = 0, binding = 1, scalar) readonly buffer Clusters { SsvpCluster items[]; } clusters;
layout(set = 0, binding = 2, scalar) readonly buffer Owners { uint items[]; } owners;
layout(set = 0, binding = 3) uniform sampler2D positions;
layout(set = 0, binding = 4) uniform sampler2D normals;
layout(set = 0, binding = 5) uniform sampler2D albedos;
layout(set = 0, binding = 6, scalar) writeonly buffer Vals { Val items[]; } vals;
layout(set = 0, binding = 7, scalar) writeonly buffer Shapes { ValShapeVectors items[]; } shapes;

vec2 placeOnMap(uint i, uint count) {
    vec2 u = hammersley(i, count);
    if (!kDisk) return 2.0 * u - 1.0;
    return sqrt(u.x) * vec2(cos(2.0 * kPi * u.y), sin(2.0 * kPi * u.y));
}

Val secondLight(uint i) {
    uint cluster = i % push.clusterCount, ofCluster = (push.secondCount - cluster - 1) / push.clusterCount + 1;
    SsvpCluster c = clusters.items[cluster];
    vec2 p = placeOnMap(i / push.clusterCount, ofCluster);
    uvec2 origin = uvec2(cluster % kSsvpMapColumns, cluster / kSsvpMapColumns) * push.mapSize;
    ivec2 texel = ivec2(origin + min(uvec2((p * 0.5 + 0.5) * float(push.mapSize)), uvec2(push.mapSize - 1)));
    vec4 hit = texelFetch(positions, texel, 0);
    float p2 = dot(p, p), cosine = (1.0 - p2) / (1.0 + p2);
    float area = kDisk ? kPi : 4.0;
    float share = max(cosine, 0.0) * kInvPi * 4.0 / ((1.0 + p2) * (1.0 + p2)) * area / float(ofCluster);
    vec3 flux = hit.w > 0.0 ? c.flux * texelFetch(albedos, texel, 0).rgb * share : vec3(0.0);
    return Val(hit.xyz, 0.0, texelFetch(normals, texel, 0).xyz, 0.0, flux, 0.0);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.valCount) return;
    Val val = Val(vec3(0.0), 0.0, vec3(0.0, 1.0, 0.0), 0.0, vec3(0.0), 0.0);
    uint map = kNoSsvpMap;
    if (i < push.firstCount) {
        val = first.items[i];
        map = min(owners.items[i], push.clusterCount - 1);
    } else if (i < push.firstCount + push.secondCount) {
        val = secondLight(i - push.firstCount);
    }
    val.area = 1e-8;
    SsvpCluster viewer = clusters.items[min(map, push.clusterCount - 1)];
    ValShapeVectors point;
    point.halfU = viewer.position;
    point.inverseRectangle = float(map);
    point.halfV = viewer.normal;
    point.inversePolygon = 0.0;
    point.gradient = vec4(0.0, 0.0, 1.0, 0.0);
    for (int k = 0; k < int(kValCorners); ++k) point.corners[k] = vec2(0.0);
    vals.items[i] = val;
    shapes.items[i] = point;
}
