#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Turns the rasterised maps into emitters: position, normal, reflected flux and area of each texel (method: RSM). Those
// beside a crease are listed to be trimmed. Texels that are points on surfaces are taken in as they are.
#include "common/lights.h"
#include "common/rsm_math.h"
#include "common/texels.glsl"
#include "rsm/rsm.glsl"

layout(local_size_x = 256) in;  // one tile
layout(constant_id = 0) const bool kHasPoints = false;  // a map of points on them
layout(push_constant, scalar) uniform Push {
    uint firstTile;
    RsmAtlas atlas;
} push;

layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D albedoMap;
layout(set = 0, binding = 2) uniform sampler2D depthMap;
layout(set = 0, binding = 3, scalar) uniform Faces { RsmFace items[kMaxRsmFaces]; } faces;
layout(set = 0, binding = 4, scalar) uniform Maps { RsmMap items[kMaxRsmMaps]; } maps;
layout(set = 0, binding = 5, scalar) writeonly buffer Texels { RsmTexel items[]; } texels;
layout(set = 0, binding = 6, scalar) writeonly buffer TileMaps { uint items[]; } tileMaps;
layout(set = 0, binding = 7) VEC4_TEXELS(points);
#define PIXEL_LIST_BINDING 8
#include "common/pixel_list.glsl"

// The face a texel lies in, or faceCount if none: a handful of faces at most, uniform within a tile.
uint findFace(uvec2 coord) {
    uint found = push.atlas.faceCount;
    for (uint i = 0; i < push.atlas.faceCount; ++i) {
        uvec2 origin = faces.items[i].origin;
        uint size = faces.items[i].size;
        if (all(greaterThanEqual(coord, origin)) && all(lessThan(coord, origin + size))) found = i;
    }
    return found;
}

RsmTexel darkTexel() { return RsmTexel(vec3(0.0), 0.0, vec3(0.0, 1.0, 0.0), 0.0, vec3(0.0), 0.0); }

// Incident power on the texel's solid angle (or, for the sun, its cross-section), in W.
vec3 incidentFlux(RsmMap map, RsmFace face, vec3 toSurface, float distance, vec2 ndc) {
    if (map.kind == kLightDirectional)
        return map.intensity * orthoTexelArea(2.0 * map.tanHalf, float(face.size));
    float cosAxis = inversesqrt(1.0 + dot(ndc, ndc) * map.tanHalf * map.tanHalf);
    float cone = spotFalloff(dot(toSurface, map.direction), map.cosInner, map.cosOuter);
    return map.intensity * cone * rangeWindow(distance, map.range) *
           perspectiveTexelSolidAngle(map.tanHalf, float(face.size), cosAxis);
}

RsmTexel makeTexel(uvec2 coord, uint faceIndex) {
    RsmFace face = faces.items[faceIndex];
    RsmMap map = maps.items[face.map];
    float depth = texelFetch(depthMap, ivec2(coord), 0).x;
    vec2 ndc = (vec2(coord - face.origin) + 0.5) / float(face.size) * 2.0 - 1.0;
    vec4 h = face.worldFromClip * vec4(ndc, depth, 1.0);
    vec3 position = h.xyz / h.w;
    vec3 normal = texelFetch(normalMap, ivec2(coord), 0).xyz;
    normal *= inversesqrt(max(dot(normal, normal), 1e-12));

    bool sun = map.kind == kLightDirectional;
    vec3 fromLight = position - map.position;
    float distance = sun ? 0.0 : length(fromLight);
    vec3 toSurface = sun ? map.direction : fromLight / max(distance, 1e-6);
    float cosine = -dot(toSurface, normal);

    vec3 incident = incidentFlux(map, face, toSurface, distance, ndc);
    vec3 flux = texelFetch(albedoMap, ivec2(coord), 0).rgb * incident;
    float crossSection = sun ? orthoTexelArea(2.0 * map.tanHalf, float(face.size))
                             : perspectiveTexelSolidAngle(map.tanHalf, float(face.size),
                                   inversesqrt(1.0 + dot(ndc, ndc) * map.tanHalf * map.tanHalf)) * distance * distance;
    float weight = (flux.x + flux.y + flux.z) / 3.0;
    bool lit = depth > 0.0 && cosine > 1e-3 && weight > 0.0;
    if (!lit) return darkTexel();
    return RsmTexel(position, crossSection / cosine, normal, weight, flux, cosine);
}

const float kRounding = 0.001;

// Whether a neighbour's surface may be another one, by normals of half floats; where nothing was drawn there is none.
bool turnsToward(RsmFace face, uvec2 coord, ivec2 side, vec3 normal) {
    ivec2 there = clamp(ivec2(coord) + side, ivec2(face.origin), ivec2(face.origin + face.size) - 1);
    vec3 other = texelFetch(normalMap, there, 0).xyz;
    return dot(other, other) > 0.5 && dot(other, normal) < (kSameSurface + kRounding) * length(other);
}

bool atCrease(RsmFace face, uvec2 coord, vec3 normal) {
    return turnsToward(face, coord, ivec2(-1, 0), normal) || turnsToward(face, coord, ivec2(1, 0), normal) ||
           turnsToward(face, coord, ivec2(0, -1), normal) || turnsToward(face, coord, ivec2(0, 1), normal);
}

RsmTexel pointTexel(RsmFace face, uint index) {
    uint point = maps.items[face.map].firstPoint + rsmIndexInFace(index, face, push.atlas.size.x);
    int at = int(point) * 3;
    vec4 a = fetchTexel(points, at), b = fetchTexel(points, at + 1), c = fetchTexel(points, at + 2);
    return RsmTexel(a.xyz, a.w, b.xyz, b.w, c.rgb, c.w);
}

void main() {
    uint tile = push.firstTile + gl_WorkGroupID.x, index = rsmTexelIndex(tile, gl_LocalInvocationID.x);
    uvec2 coord = rsmTexelCoord(tile, gl_LocalInvocationID.x, push.atlas.size.x);
    uint found = findFace(coord);
    RsmFace face = faces.items[min(found, push.atlas.faceCount - 1)];
    bool ofMap = found < push.atlas.faceCount, ofSurfaces = maps.items[face.map].kind == kMapOfSurfaces;
    RsmTexel texel = darkTexel();
    if (ofMap && !ofSurfaces && !inHole(maps.items[face.map], vec2(coord - face.origin))) {
        texel = makeTexel(coord, found);
        if (texel.weight > 0.0 && atCrease(face, coord, texel.normal)) listPixel(ivec2(coord));
    }
    if (kHasPoints && ofMap && ofSurfaces) texel = pointTexel(face, index);
    texels.items[index] = texel;
    if (gl_LocalInvocationID.x == 0) tileMaps.items[tile] = ofMap ? face.map : 0xffffffffu;
}
