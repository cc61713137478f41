// Points on surfaces: those that stand for all of them in every bounce after the first, and those that shine.
#ifndef AG_LATER_BOUNCES_IO_H
#define AG_LATER_BOUNCES_IO_H

#include "common/portable.h"
#include "surface_points/surface_points_io.h"

#ifdef __cplusplus
namespace ag::io {
#endif

// Of a skinned mesh's instance: positionLocal and normalLocal hold a SkinnedSample's weights and corners' x,
// y, z, edgesLocal[0].inward.x its corners.w, all of them bits.
struct BouncePoint {  // moves with its instance
    vec3 positionLocal;
    uint instance;
    vec3 normalLocal;  // unit
    float area;        // m² it stands for; 0: none
    vec3 albedo;  // diffuse, the mean of what it stands for; of one that shines: its radiance, W/(m² sr)
    SurfaceEdge edgesLocal[2];
};

const float kMostAlbedo = 0.95;  // in the loop of bounces, which would not end otherwise

struct EmitPush {
    uint count;
    uint reflecting;  // of them the first so many reflect, the others shine
    uint firstPoint;  // the first one's place among all points
    uint known;       // 1: there is irradiance of the frame before
};

struct PointLight {  // whose light is looked for at points alone
    vec3 position;
    float range;     // m, 0: no end
    vec3 intensity;  // W/sr; directional: W/m² on a plane facing it
    uint directional;
    vec3 direction;            // the way the light travels, unit
    float cosInner, cosOuter;  // of a light to all sides both below -1
};

struct PointLightsPush {
    uint count;  // points
    uint lightCount;
    float offset;  // m: rays leave surfaces so far before them
    float reach;   // m: beyond it nothing stands
};

// Of a point's irradiance, W/m², over frames.
struct PointMeans {
    vec3 byRays, byLights;
    float frames;
};

struct TracePush {
    uint count;       // points
    uint valCount;    // lights
    uint firstLater;  // the first that stands for points
    uint rays;        // a frame, to either kind
    uint step;
    uint turns;         // frames in which each point has rays once
    uint valid;         // 0: there are no means before
    float mostLength;   // frames that means stand for
    float offset;       // m: rays leave and reach surfaces so far before them at least
    float texelOffset;  // the same in texels
    uint atlasWidth;    // texels, of reflective shadow maps
    float nearReach;    // m, of rays into the hemisphere
};

const uint kRunPoints = 64;  // one after another, which share lists of near and far lights

const uint kConserveLanes = 256;

struct GatherPush {
    uint count;
    uint valCount;
    float nearReach;   // as ValShadingPush's
    uint ismTileSize;  // texels along a shadow map's side
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
