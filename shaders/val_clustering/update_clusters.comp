#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_arithmetic : require
// Segmented update, second half: each cluster gathers its sums from the tiles that list it and becomes their
// flux-weighted mean. Flux and area are sums over the texels (not the centre's sample: ACRSM section 4.7 differs).
#include "common/lane_loop.glsl"
#include "rsm/rsm_io.h"
#include "val_clustering/val_clustering_io.h"

layout(local_size_x_id = 100) in;  // one subgroup a cluster
layout(push_constant, scalar) uniform Push { ClusterSettings settings; } push;

layout(set = 0, binding = 0, scalar) readonly buffer Seeds { ClusterSeed items[]; } seeds;
layout(set = 0, binding = 1, scalar) readonly buffer Maps { RsmMap items[]; } maps;
layout(set = 0, binding = 2) uniform usamplerBuffer slotOfCluster;
layout(set = 0, binding = 3) uniform samplerBuffer partials;
layout(set = 0, binding = 4, scalar) writeonly buffer Clusters { Cluster items[]; } clusters;

void main() {
    uint cluster = gl_WorkGroupID.x;
    uint tileCount = (push.settings.atlasSize.x / kRsmTileSize) * (push.settings.atlasSize.y / kRsmTileSize);
    vec4 sums[kPartialVec4s] = vec4[](vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
    for (uint base = 0; base < tileCount; base += kSubgroupSize) {
        uint tile = min(base + gl_SubgroupInvocationID, tileCount - 1);
        uint slot = texelFetch(slotOfCluster, int(tile * push.settings.clusterCount + cluster)).x;
        bool listed = slot != kNoCluster && base + gl_SubgroupInvocationID < tileCount;
        int at = int((tile * kMaxCandidates + (listed ? slot : 0)) * kPartialVec4s);
        if (listed)
            for (int i = 0; i < int(kPartialVec4s); ++i) sums[i] += texelFetch(partials, at + i);
    }
    for (int i = 0; i < int(kPartialVec4s); ++i) sums[i] = subgroupAdd(sums[i]);
    if (gl_SubgroupInvocationID != 0) return;

    ClusterSeed seed = seeds.items[cluster];
    Cluster c;
    c.flux = sums[0].xyz;
    c.area = sums[0].w;
    c.texelCount = sums[2].w;
    bool empty = c.texelCount == 0.0;
    float invWeight = empty ? 0.0 : 1.0 / max(sums[1].w, 1e-38);
    vec3 offset = sums[1].xyz * invWeight;
    c.position = seed.position + offset;
    vec3 meanNormal = sums[2].xyz * invWeight;
    c.cosineSpread = length(meanNormal);
    c.normal = c.cosineSpread > 1e-6 ? meanNormal / c.cosineSpread : seed.normal;
    c.chroma = empty ? seed.chroma : c.flux / max(length(c.flux), 1e-38);
    c.covarianceDiagonal = max(sums[3].xyz * invWeight - offset * offset, vec3(0.0));
    c.covarianceMixed = sums[4].xyz * invWeight - offset.xxy * offset.yzz;
    c.lightIdLow = maps.items[seed.map].lightIdLow;
    c.map = seed.map;
    c.age = seed.age;
    clusters.items[cluster] = c;
}
