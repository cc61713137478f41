#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// A texel stands for the part of its square up to where its surface meets its neighbours', not for all of it: area and
// flux move across creases to the surface they belong to. Only those that were listed. What neighbours are read for,
// position, normal and cosine, stays as it is.
#include "common/texels.glsl"
#include "rsm/rsm.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { RsmAtlas atlas; } push;

layout(set = 0, binding = 0) VEC4_TEXELS(texels);
layout(set = 0, binding = 1, scalar) readonly buffer TileMaps { uint items[]; } tileMaps;
layout(set = 0, binding = 2, scalar) uniform Faces { RsmFace items[kMaxRsmFaces]; } faces;
layout(set = 0, binding = 3, scalar) uniform Maps { RsmMap items[kMaxRsmMaps]; } maps;
layout(set = 0, binding = 4, scalar) buffer Trimmed { RsmTexel items[]; } trimmed;
layout(set = 0, binding = 5, scalar) readonly buffer Creased { uint count; uint pixels[]; } creased;

#include "rsm/footprint.glsl"

void main() {
    if (gl_GlobalInvocationID.x >= creased.count) return;
    uint packed = creased.pixels[gl_GlobalInvocationID.x];
    uint index = rsmIndexOfCoord(uvec2(packed & 0xffffu, packed >> 16), push.atlas.size.x);
    Reach r = reachOf(viewTexel(index, tileMaps.items[index / (kRsmTileSize * kRsmTileSize)], push.atlas.size.x));
    float share = (r.left + r.right) * (r.down + r.up);
    trimmed.items[index].area *= share;
    trimmed.items[index].weight *= share;
    trimmed.items[index].flux *= share;
}
