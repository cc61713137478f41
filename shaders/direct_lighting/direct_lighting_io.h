// Lights as direct lighting takes them: suns one by one, punctual lights (spots and points) by tiles of the
// screen and in clusters that share a shadow map.
#ifndef AG_DIRECT_LIGHTING_IO_H
#define AG_DIRECT_LIGHTING_IO_H

#include "common/portable.h"

#ifdef __cplusplus
namespace ag::io {
#endif

const uint kMaxPunctualLightsPerTile = 1024;  // further ones, in the order of clusters, are left out
const uint kPunctualTileSize = 16;            // pixels
const uint kNoLightCluster = 0xffffffffu;

struct RayOffsets {  // so far before surfaces shadow rays leave
    float least;     // m
    float ofPixel;   // of a pixel's width: a rasteriser draws between corners it has moved
};

struct Sun {
    vec3 direction;   // the way the light travels, unit
    uint firstView;   // index into the shadow views
    vec3 irradiance;  // W/m² on a plane facing the light
    uint viewCount;   // 0: casts no shadow
    RayOffsets offsets;
    float rayReach;  // m: beyond it nothing stands
};

struct PunctualLight {    // 4 vec4; sorted by cluster
    vec3 position;        // m
    float inverseRange2;  // 1/m², 0: no limit
    vec3 intensity;       // W/sr
    uint cluster;         // kNoLightCluster: casts no shadow
    // Of a spot, against the way the light travels, over the span of cosines it fades in. The share of the
    // axial intensity is (dot(axis, to the light) + coneOffset)², within 0 and 1.
    vec3 axis;
    float coneOffset;
    float clusterDistance;  // m from its cluster's centre
    uvec2 id;               // of the light, low and high word
    uint unused;
};

struct PunctualRelevance {
    uvec2 id;
    float relevance;  // W/m² without shadows, summed over channels and points of the view; 0: not a light
};

struct LightClusterRow {  // 4 vec4
    vec3 center;          // m
    float radius;         // m, of the light its shadows have
    vec3 direction;       // of a spot's single view; zero: six faces of a cube
    float tanHalf;        // of a view's half angle
    uvec2 origin;         // first texel of the first view; the others' lie beside it, three a row
    uint size;            // texels along a view's side
    float nearDistance;   // m, of the views' planes
    float farDistance;
    uint unused[3];
};

struct PunctualPush {
    uint lightCount;
};

struct MeasurePush {
    uint lightCount, pointCount;  // of the view's points, the first so many
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
