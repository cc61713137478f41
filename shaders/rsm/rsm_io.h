// Reflective shadow maps: one atlas, a face per view of a bounce light (spot and sun one, point six).
#ifndef AG_RSM_IO_H
#define AG_RSM_IO_H

#include "common/portable.h"

#ifdef __cplusplus
namespace ag::io {
#endif

const uint kMaxBounceLights = 8;
const uint kMostSunLevels = 4;  // maps of one sun in a large scene
const uint kMaxLightMaps = kMaxBounceLights + kMostSunLevels - 1;
const uint kMaxRsmMaps = kMaxLightMaps + 2;  // and those of surfaces that shine and of all that reflect
const uint kMaxRsmFaces = 50;
const uint kMapOfSurfaces = 3;  // kind of a map whose texels are points on surfaces: none projects to it
const uint kRsmTileSize = 16;   // texels; faces start and end on tile borders

struct RsmFace {  // 9 vec4
    mat4 worldFromClip;
    mat4 clipFromWorld;
    uvec2 origin;  // first texel in the atlas
    uint size;     // texels along a side
    uint map;      // which RsmMap it belongs to
};

struct RsmMap {     // 6 vec4: all faces of one bounce light
    vec3 position;  // m
    uint kind;      // kLightDirectional, kLightPoint, kLightSpot, kMapOfSurfaces
    vec3 direction;
    float range;
    vec3 intensity;  // W/sr; directional: W/m²
    float cosInner;  // of a light to all sides both below -1
    float cosOuter;
    float tanHalf;  // of a perspective face's opening; directional: half its width in m
    uint firstFace;
    uint faceCount;
    uint firstCluster;
    uint clusterCount;
    uint id;               // stable identity of the map, to carry clusters over
    uint candidateRadius;  // tiles: clusters this near to a texel's tile are candidates for it
    uint firstPoint;       // kMapOfSurfaces: the first texel's among all points
    uvec2 holeBegin;       // texels of the face: what is in another level's map
    uint holeSize;         // 0: there is none
};

struct RsmTexel {         // 3 vec4; a texel is a small emitter (method: RSM)
    vec3 position;        // m
    float area;           // m²
    vec3 normal;          // unit
    float weight;         // mean of the flux's channels, W; 0: unlit, no emitter
    vec3 flux;            // reflected, W
    float emitterCosine;  // light to normal at the texel; 0: unlit. Of a point: share of its light that area
                          // lights and the sky sent
};

struct RsmAtlas {  // push constants of the passes that walk the atlas
    uvec2 size;    // texels, whole tiles
    uint faceCount;
    uint mapCount;
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
