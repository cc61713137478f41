#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// First-bounce lights: RSM texels under a Hammersley set, the same one every frame, each with its share of the
// map's texels (SSVP section III-A).
#include "common/sampling.h"
#include "common/texels.glsl"
#include "rsm/rsm.glsl"
#include "val_fit/val_fit_io.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { uint vplCount, atlasWidth, mapCount; } push;

layout(set = 0, binding = 0) VEC4_TEXELS(texels);
layout(set = 0, binding = 1, scalar) uniform Faces { RsmFace items[kMaxRsmFaces]; } faces;
layout(set = 0, binding = 2, scalar) uniform Maps { RsmMap items[kMaxRsmMaps]; } maps;
layout(set = 0, binding = 3, scalar) writeonly buffer Vpls { Val items[]; } vpls;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.vplCount) return;
    uint mapIndex = 0;
    for (uint m = 0; m < push.mapCount; ++m)
        if (i >= maps.items[m].firstCluster) mapIndex = m;
    RsmMap map = maps.items[mapIndex];
    vec2 u = hammersley(i - map.firstCluster, map.clusterCount);
    float along = u.x * float(map.faceCount);
    uint inMap = min(uint(along), map.faceCount - 1);
    RsmFace face = faces.items[map.firstFace + inMap];
    uvec2 inFace = min(uvec2(vec2(along - float(inMap), u.y) * float(face.size)), uvec2(face.size - 1));
    RsmSurface s = AG_RSM_FETCH(texels, rsmIndexOfCoord(face.origin + inFace, push.atlasWidth));
    float texelsOfLight = float(map.faceCount * face.size * face.size) / float(map.clusterCount);
    vpls.items[i] = Val(s.position, 0.0, s.normal, 0.0, s.weight > 0.0 ? s.flux * texelsOfLight : vec3(0.0), 0.0);
}
