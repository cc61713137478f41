// A virtual area light in registers: loading it, handing it from lane to lane, what it sends to a place. Needs buffers
// `vals`, `shapes`, `isms`, the constants kShape and kVisibilityTaps.
#ifndef AG_AREA_LIGHT_GLSL
#define AG_AREA_LIGHT_GLSL

#include "common/form_factors.h"
#include "common/lane_loop.glsl"
#include "common/sampling.h"
#include "ism_atlas/ism_lookup.glsl"
#include "val_fit/val_fit_io.h"

const uint kShapePoint = 0;
const uint kShapeDisk = 1;        // as published: RSMC eq. 2
const uint kShapeVectorDisk = 2;  // closed form of a disk's vector irradiance
const uint kShapeRectangle = 3;   // of the second moments, by its edges
const uint kShapePolygon = 4;     // of the farthest texels, by its edges

const bool kPolygon = kShape == kShapePolygon;
const bool kSoft = kVisibilityTaps > 1;  // else shadows are hard, or with 0 taps none
#ifdef AG_GLOSSY
const bool kRectangle = true;
#elif defined(AG_SHARED_MAPS)
const bool kRectangle = kShape == kShapeRectangle || kSoft || kSharedMaps;
#else
const bool kRectangle = kShape == kShapeRectangle || kSoft;
#endif

struct AreaLight {
    vec4 place;   // centre; area, or radius² of a vector disk
    vec3 normal;
    float thickness;  // of a polygon
    vec4 power;   // flux, or radiosity where the shape's term is a form factor; how far texels stand before the centre
    vec3 halfU, halfV;
    vec4 corners[kValCorners / 2];  // two each
    vec4 gradient;
    uint map;  // of depths
};

AreaLight loadLight(uint index) {
    AreaLight l;
    int at = int(index) * 3, shape = int(index * kValShapeVec4s);
    l.place = fetchTexel(vals, at);
    vec4 normal = fetchTexel(vals, at + 1);
    l.normal = normal.xyz;
    l.thickness = kPolygon ? normal.w : 0.0;
    l.power = fetchTexel(vals, at + 2);
    vec4 u = kRectangle ? fetchTexel(shapes, shape) : vec4(0.0);
#ifdef AG_SHARED_MAPS
    l.map = kSharedMaps ? uint(u.w) : index;
#else
    l.map = index;
#endif
    vec4 v = kRectangle || kPolygon ? fetchTexel(shapes, shape + 1) : vec4(0.0);
    l.halfU = u.xyz;
    l.halfV = v.xyz;
    [[unroll]] for (int i = 0; i < int(kValCorners) / 2; ++i)
        l.corners[i] = kPolygon ? fetchTexel(shapes, shape + 2 + i) : vec4(0.0);
    l.gradient = kPolygon ? fetchTexel(shapes, shape + 6) : vec4(0.0);
    if (kShape == kShapeVectorDisk) {
        l.power.rgb /= l.place.w;
        l.place.w *= kInvPi;
    }
    if (kShape == kShapeRectangle) l.power.rgb *= u.w;
    if (kPolygon) l.power.rgb *= v.w;
    return l;
}

// The light another lane holds.
AreaLight lightOfLane(AreaLight mine, uint lane) {
    AreaLight l;
    l.map = subgroupShuffle(mine.map, lane);
    l.place = subgroupShuffle(mine.place, lane);
    l.normal = subgroupShuffle(mine.normal, lane);
    l.thickness = kPolygon ? subgroupShuffle(mine.thickness, lane) : 0.0;
    l.power = subgroupShuffle(mine.power, lane);
    l.halfU = kRectangle ? subgroupShuffle(mine.halfU, lane) : vec3(0.0);
    l.halfV = kRectangle ? subgroupShuffle(mine.halfV, lane) : vec3(0.0);
    [[unroll]] for (int i = 0; i < int(kValCorners) / 2; ++i)
        l.corners[i] = kPolygon ? subgroupShuffle(mine.corners[i], lane) : vec4(0.0);
    l.gradient = kPolygon ? subgroupShuffle(mine.gradient, lane) : vec4(0.0);
    return l;
}

struct LightFrame {
    vec3 t, b, n;
};

LightFrame frameOf(AreaLight l) {
    LightFrame f;
    f.n = l.normal;
    orthonormalBasis(l.normal, f.t, f.b);
    return f;
}

vec3 toFrame(LightFrame f, vec3 v) { return vec3(dot(v, f.t), dot(v, f.b), dot(v, f.n)); }

float shapeTerm(vec3 x, vec3 n, float width, AreaLight l, LightFrame f) {
    if (kShape == kShapePoint) return vplTerm(x, n, l.place.xyz, l.normal);
    if (kShape == kShapeDisk) return diskPublishedTerm(x, n, l.place.xyz, l.normal, l.place.w);
    if (kShape == kShapeVectorDisk) return diskVectorFactor(x, n, l.place.xyz, l.normal, l.place.w);
    if (kShape == kShapeRectangle) return rectangleVectorFactor(x, n, l.place.xyz, l.normal, l.halfU, l.halfV);
    vec2 corners[kValCorners];
    [[unroll]] for (int i = 0; i < int(kValCorners) / 2; ++i) {
        corners[2 * i] = l.corners[i].xy;
        corners[2 * i + 1] = l.corners[i].zw;
    }
    vec3 p = toFrame(f, x - l.place.xyz);
    float below = 1.0;
    float thickness = abs(l.thickness);
    if (l.thickness < 0.0) below = outsideBulge(p, corners, l.power.w, thickness, l.gradient.w);
    if (thickness > 0.25 * width) {
        vec2 layers = layersBelow(p.z, thickness);
        below *= layers.x;
        p.z = layers.y;
    }
    return below * polygonVectorFactor(p, toFrame(f, n), corners, l.gradient, 0.25 * width);
}

IsmTile tileOf(AreaLight l, uint ismTileSize) {
    return IsmTile(int(l.map * ismTileSize * ismTileSize), int(ismTileSize));
}

#ifdef AG_SHARED_MAPS
// By the map of the light's cluster, seen from halfU with normal halfV, with hard edges (Dong et al. 2009).
float sharedVisibility(vec3 x, AreaLight l, uint ismTileSize) {
    vec3 t, b, d = x - l.halfU;
    orthonormalBasis(l.halfV, t, b);
    d = vec3(dot(d, t), dot(d, b), dot(d, l.halfV));
    return l.map == kNoMap ? 1.0 : ismHardVisibility(tileOf(l, ismTileSize), d);
}
#endif

float visibility(vec3 x, AreaLight l, LightFrame f, uint ismTileSize) {
    if (kVisibilityTaps == 0) return 1.0;
#ifdef AG_SHARED_MAPS
    if (kSharedMaps) return sharedVisibility(x, l, ismTileSize);
#endif
    vec3 d = toFrame(f, x - l.place.xyz) - vec3(0.0, 0.0, l.power.w);
    IsmTile tile = tileOf(l, ismTileSize);
    if (!kSoft) return ismHardVisibility(tile, d);
    return ismSoftVisibility(tile, d, toFrame(f, l.halfU).xy, toFrame(f, l.halfV).xy, kVisibilityTaps);
}

// At a receiver of some width, m, that the light may be as near to.
vec3 irradianceFrom(AreaLight l, vec3 x, vec3 n, float width, uint ismTileSize) {
    LightFrame f = frameOf(l);
    return l.power.rgb * (shapeTerm(x, n, width, l, f) * visibility(x, l, f, ismTileSize));
}
#endif
