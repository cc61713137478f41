#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Where each cluster starts this step: its place of the last step (carried over in world space), or, if it was empty,
// changed its light or left the map, a Halton point warped by importance (RSMC section 4; ACRSM algorithm 5.3).
#include "common/sampling.h"
#include "common/texels.glsl"
#include "rsm/rsm.glsl"
#include "val_clustering/val_clustering_io.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kAdaptive = false;
layout(push_constant, scalar) uniform Push {
    ClusterSettings settings;
    uint faceCount;
    uint pyramidStride;
} push;

layout(set = 0, binding = 0) VEC4_TEXELS(texels);
layout(set = 0, binding = 1, scalar) uniform Faces { RsmFace items[kMaxRsmFaces]; } faces;
layout(set = 0, binding = 2, scalar) uniform Maps { RsmMap items[kMaxRsmMaps]; } maps;
layout(set = 0, binding = 3, scalar) readonly buffer Pyramid { float items[]; } pyramid;
layout(set = 0, binding = 4, scalar) readonly buffer Previous { Cluster items[]; } previous;
layout(set = 0, binding = 6, scalar) readonly buffer Plans { uint items[]; } plans;
layout(set = 0, binding = 5, scalar) writeonly buffer Seeds { ClusterSeed items[]; } seeds;
#include "importance/warp.glsl"

// The tile a world position falls into, kNoCluster outside all faces of the map.
uint projectToTile(vec3 position, RsmMap map) {
    if (map.kind == kMapOfSurfaces)  // all of its tiles are near
        return rsmTileOfCoord(faces.items[map.firstFace].origin, push.settings.atlasSize.x);
    uint tile = kNoCluster;
    for (uint i = 0; i < map.faceCount; ++i) {
        RsmFace face = faces.items[map.firstFace + i];
        vec4 clip = face.clipFromWorld * vec4(position, 1.0);
        vec2 uv = clip.xy / clip.w * 0.5 + 0.5;
        bool inside = clip.w > 0.0 && all(greaterThanEqual(uv, vec2(0.0))) && all(lessThan(uv, vec2(1.0)));
        if (inside) tile = rsmTileOfCoord(face.origin + min(uvec2(uv * float(face.size)), uvec2(face.size - 1)), push.settings.atlasSize.x);
    }
    return tile;
}

ClusterSeed deadSeed(uint map) {
    return ClusterSeed(vec3(0.0), kNoCluster, vec3(0.0, 1.0, 0.0), map, vec3(0.0), 0.0);
}

ClusterSeed seedFromTexel(uint texel, uint mapIndex) {
    RsmSurface s = AG_RSM_FETCH(texels, texel);
    return ClusterSeed(s.position, texel / (kRsmTileSize * kRsmTileSize), s.normal, mapIndex, s.flux / length(s.flux), 0.0);
}

ClusterSeed seedFromImportance(uint cluster, uint mapIndex) {
    RsmMap map = maps.items[mapIndex];
    vec2 u = halton23(1 + (cluster + push.settings.step * kMaxClusters) % 4194304u);
    uint face = chooseFace(map, push.pyramidStride, u.x);
    uvec2 block = warpToBlock(face, push.pyramidStride, u);
    uint texel = litTexelOfBlock(push.settings.atlasSize.x, face, block, u);
    return texel == kNoCluster ? deadSeed(mapIndex) : seedFromTexel(texel, mapIndex);
}

void main() {
    uint cluster = gl_GlobalInvocationID.x;
    if (cluster >= push.settings.clusterCount) return;
    uint mapIndex = 0;
    for (uint i = 0; i < push.settings.mapCount; ++i)
        if (cluster - maps.items[i].firstCluster < maps.items[i].clusterCount) mapIndex = i;  // before it: beyond any count
    uint inMap = cluster - maps.items[mapIndex].firstCluster;
    if (inMap >= maps.items[mapIndex].clusterCount) {
        seeds.items[cluster] = deadSeed(mapIndex);
        return;
    }

    uint plan = kAdaptive ? plans.items[cluster] : kPlanKeep;
    if (plan != kPlanKeep && plan != kPlanAnew) {
        seeds.items[cluster] = seedFromTexel(plan, mapIndex);
        return;
    }
    Cluster before = previous.items[cluster];
    bool kept = before.texelCount > 0.0 && before.mapId == maps.items[mapIndex].id;
    uint tile = kept ? projectToTile(before.position, maps.items[mapIndex]) : kNoCluster;
    if (tile != kNoCluster)
        seeds.items[cluster] =
            ClusterSeed(before.position, tile, before.normal, mapIndex, before.chroma, before.age + 1.0);
    else
        seeds.items[cluster] = seedFromImportance(cluster, mapIndex);
}
