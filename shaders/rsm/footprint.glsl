// What an RSM texel covers of its surface. Needs buffers `texels`, `faces` and `maps`.
#ifndef AG_FOOTPRINT_GLSL
#define AG_FOOTPRINT_GLSL

#extension GL_EXT_control_flow_attributes : require
#include "rsm/rsm.glsl"

const float kMostStretch = 4.0;  // of a footprint seen slantwise, over the root of its area

struct TexelView {  // a texel and the rays round it
    RsmSurface s;
    RsmMap map;
    RsmFace face;
    uvec2 inFace;
    vec3 ndc;
    uint atlasWidth;
};

TexelView viewTexel(uint texel, uint mapIndex, uint atlasWidth) {
    TexelView v;
    v.s = AG_RSM_FETCH(texels, texel);
    v.map = maps.items[mapIndex];
    v.atlasWidth = atlasWidth;
    const uint kTileTexels = kRsmTileSize * kRsmTileSize;
    uvec2 coord = rsmTexelCoord(texel / kTileTexels, texel % kTileTexels, atlasWidth);
    uint found = v.map.firstFace;
    for (uint i = 0; i < v.map.faceCount; ++i) {
        RsmFace f = faces.items[v.map.firstFace + i];
        if (all(lessThan(coord - f.origin, uvec2(f.size)))) found = v.map.firstFace + i;  // wraps round below
    }
    v.face = faces.items[found];
    v.inFace = coord - v.face.origin;
    vec4 clip = v.face.clipFromWorld * vec4(v.s.position, 1.0);
    v.ndc = clip.xyz / clip.w;
    return v;
}

// Where the light's ray so many texels aside meets the texel's plane.
vec3 onPlaneAside(TexelView v, vec2 aside) {
    vec4 h = v.face.worldFromClip * vec4(v.ndc.xy + aside * (2.0 / float(v.face.size)), v.ndc.z, 1.0);
    vec3 through = h.xyz / h.w;
    vec3 ray = v.map.kind == kLightDirectional ? v.map.direction : through - v.map.position;
    return through + ray * (dot(v.s.position - through, v.s.normal) / min(dot(ray, v.s.normal), -1e-6));
}

// The same, not far away where the light grazes the plane.
vec3 onPlane(TexelView v, vec2 aside) {
    vec3 offset = onPlaneAside(v, aside) - v.s.position;
    float most = kMostStretch * sqrt(v.s.area);
    return v.s.position + offset * min(1.0, most * inversesqrt(max(dot(offset, offset), 1e-20)));
}

// How far the surface goes toward a neighbour, in texels: half way, or to the edge where the two planes meet.
float reachToward(TexelView v, ivec2 side) {
    ivec2 there = ivec2(v.inFace) + side;
    if (any(lessThan(there, ivec2(0))) || any(greaterThanEqual(there, ivec2(v.face.size)))) return 0.5;
    RsmSurface other = AG_RSM_FETCH(texels, rsmIndexOfCoord(uvec2(there) + v.face.origin, v.atlasWidth));
    if (other.cosine <= 0.0 || dot(other.normal, v.s.normal) > kSameSurface) return 0.5;
    float here = dot(v.s.position - other.position, other.normal);
    float beyond = dot(onPlane(v, vec2(side)) - other.position, other.normal);
    float share = here / (here - beyond);
    return share >= 0.0 && share <= 1.0 ? share : 0.5;
}

struct Reach {  // texels
    float left, right, down, up;
};

Reach reachOf(TexelView v) {
    return Reach(reachToward(v, ivec2(-1, 0)), reachToward(v, ivec2(1, 0)), reachToward(v, ivec2(0, -1)),
                 reachToward(v, ivec2(0, 1)));
}
#endif
