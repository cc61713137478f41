#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// A texel stands for the part of its square up to where its surface meets its neighbours', not for all of it: area and
// flux move across creases to the surface they belong to. Texels that are points on surfaces are taken in as they are.
#include "rsm/rsm.glsl"

layout(local_size_x = 256) in;  // one tile
layout(push_constant, scalar) uniform Push { RsmAtlas atlas; } push;

layout(set = 0, binding = 0) uniform samplerBuffer texels;
layout(set = 0, binding = 1, scalar) readonly buffer TileMaps { uint items[]; } tileMaps;
layout(set = 0, binding = 2, scalar) uniform Faces { RsmFace items[kMaxRsmFaces]; } faces;
layout(set = 0, binding = 3, scalar) uniform Maps { RsmMap items[kMaxRsmMaps]; } maps;
layout(set = 0, binding = 5) uniform samplerBuffer later;
layout(set = 0, binding = 4, scalar) writeonly buffer Trimmed { vec4 items[]; } trimmed;

#include "rsm/footprint.glsl"

void main() {
    uint tile = gl_WorkGroupID.x, index = rsmTexelIndex(tile, gl_LocalInvocationID.x);
    vec4 a = texelFetch(texels, int(index) * 3);
    vec4 b = texelFetch(texels, int(index) * 3 + 1);
    vec4 c = texelFetch(texels, int(index) * 3 + 2);
    uint map = tileMaps.items[tile];
    RsmMap m = maps.items[min(map, push.atlas.mapCount - 1)];
    bool surfaces = map < push.atlas.mapCount && m.kind == kMapOfSurfaces;
    if (surfaces) {
        int at = int(rsmIndexInFace(index, faces.items[m.firstFace], push.atlas.size.x)) * 3;
        a = texelFetch(later, at);
        b = texelFetch(later, at + 1);
        c = texelFetch(later, at + 2);
    }
    if (b.w > 0.0 && !surfaces) {
        Reach r = reachOf(viewTexel(index, tileMaps.items[tile], push.atlas.size.x));
        float share = (r.left + r.right) * (r.down + r.up);
        a.w *= share;
        b.w *= share;
        c.rgb *= share;
    }
    trimmed.items[index * 3] = a;
    trimmed.items[index * 3 + 1] = b;
    trimmed.items[index * 3 + 2] = c;
}
