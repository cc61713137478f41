#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Virtual point lights (Keller 1997; Ritschel et al. 2008): RSM texels under Halton points warped by importance,
// each with its block's flux over the block's chance, so that the mean of the lights' total is that of the map.
#include "common/sampling.h"
#include "common/texels.glsl"
#include "rsm/rsm.glsl"
#include "val_clustering/val_clustering_io.h"
#include "val_fit/val_fit_io.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push {
    uint vplCount;
    uint valCount;  // with padding
    uint atlasWidth, mapCount, pyramidStride;
} push;

layout(set = 0, binding = 0) VEC4_TEXELS(texels);
layout(set = 0, binding = 1, scalar) uniform Faces { RsmFace items[kMaxRsmFaces]; } faces;
layout(set = 0, binding = 2, scalar) uniform Maps { RsmMap items[kMaxRsmMaps]; } maps;
layout(set = 0, binding = 3, scalar) readonly buffer Pyramid { float items[]; } pyramid;
layout(set = 0, binding = 4, scalar) writeonly buffer Vals { Val items[]; } vals;
layout(set = 0, binding = 5, scalar) writeonly buffer Shapes { ValShapeVectors items[]; } shapes;
#include "importance/warp.glsl"

vec3 fluxOfBlock(uint face, uvec2 block) {
    uint side = blockSide(faces.items[face].size);
    uvec2 origin = faces.items[face].origin + block * side;
    vec3 sum = vec3(0.0);
    for (uint i = 0; i < side * side; ++i) {
        uvec2 coord = origin + uvec2(i % side, i / side);
        sum += fetchTexel(texels, int(rsmIndexOfCoord(coord, push.atlasWidth)) * 3 + 2).rgb;
    }
    return sum;
}

Val sampleMap(RsmMap map, uint i, Val black) {
    vec2 u = halton23(1 + i);
    uint face = chooseFace(map, push.pyramidStride, u.x);
    uvec2 block = warpToBlock(face, push.pyramidStride, u);
    uint texel = litTexelOfBlock(push.atlasWidth, face, block, u);
    float importance = pyramid.items[face * push.pyramidStride + mortonFromCell(block)];
    if (texel == kNoCluster || importance <= 0.0) return black;
    RsmSurface s = AG_RSM_FETCH(texels, texel);
    float perLight = mapImportance(map, push.pyramidStride) / (importance * float(map.clusterCount));
    return Val(s.position, 0.0, s.normal, 0.0, fluxOfBlock(face, block) * perLight, 0.0);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.valCount) return;
    uint mapIndex = 0;
    for (uint m = 0; m < push.mapCount; ++m)
        if (i >= maps.items[m].firstCluster) mapIndex = m;
    RsmMap map = maps.items[mapIndex];
    Val val = Val(vec3(0.0), 1.0, vec3(0.0, 1.0, 0.0), 0.0, vec3(0.0), 0.0);
    uint inMap = i - map.firstCluster;  // before the first map: beyond any count
    if (i < push.vplCount && inMap < map.clusterCount) val = sampleMap(map, inMap, val);
    val.area = 1e-8;
    ValShapeVectors point;
    point.halfU = point.halfV = vec3(0.0);
    point.inverseRectangle = point.inversePolygon = 0.0;
    point.gradient = vec4(0.0, 0.0, 1.0, 0.0);
    for (int k = 0; k < int(kValCorners); ++k) point.corners[k] = vec2(0.0);
    vals.items[i] = val;
    shapes.items[i] = point;
}
