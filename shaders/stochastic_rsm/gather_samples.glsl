// Irradiance from one map's texels within a disk about the pixel's projection (Dachsbacher & Stamminger 2005):
// samples at radius xi R are dense in the middle and weigh xi, so that E = 2 pi R² N² mean(xi x texel's term). A
// point light's disk lies in the plane touching the unit sphere towards the pixel and covers a hemisphere at most.
#include "common/form_factors.h"
#include "common/lights.h"
#include "common/rsm_math.h"
#include "common/sampling.h"
#include "common/texels.glsl"
#include "gbuffer/gbuffer.glsl"
#include "rsm/rsm.glsl"
#include "stochastic_rsm/stochastic_rsm_io.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { StochasticRsmPush p; } push;
layout(constant_id = 0) const uint kKind = kLightSpot;
layout(constant_id = 1) const bool kListed = false;  // pixels from the list instead of a grid
layout(constant_id = 2) const bool kFirst = true;    // starts from zero instead of adding

layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2, scalar) uniform Camera { CameraConstants camera; } camera;
layout(set = 0, binding = 3) VEC4_TEXELS(texels);
layout(set = 0, binding = 4, scalar) uniform Faces { RsmFace items[kMaxRsmFaces]; } faces;
layout(set = 0, binding = 5, scalar) uniform Maps { RsmMap items[kMaxRsmMaps]; } maps;
layout(constant_id = 4) const bool kRandom = false;  // the pattern is shifted in each pixel and frame
layout(constant_id = 5) const bool kWhole = false;   // every other sample from anywhere in the map; not of point lights
layout(set = 0, binding = 6) VEC4_TEXELS(pattern);  // unit direction; radius in the disk; share of the full angle
layout(set = 0, binding = 9) UINT_TEXELS(noise);  // two 16-bit shares each
layout(set = 0, binding = 7, scalar) readonly buffer List { uint count; uint pixels[]; } list;
layout(set = 0, binding = 8, rgba16f) uniform image2D irradiance;

#ifdef AG_VISIBLE
#include "val_clustering/val_clustering_io.h"
layout(set = 0, binding = 10) UINT_TEXELS(slotOfTexel);
layout(set = 0, binding = 11) UINT_TEXELS(candidates);
layout(set = 0, binding = 12) VEC4_TEXELS(vals);
layout(set = 0, binding = 13) VEC4_TEXELS(isms);
#include "ism_atlas/ism_lookup.glsl"

float sampleVisibility(uint texel, vec3 x) {
    uint slot = fetchTexel(slotOfTexel, int(texel)).x, tile = texel / (kRsmTileSize * kRsmTileSize);
    bool known = slot != kNoCluster;
    int cluster = int(fetchTexel(candidates, known ? int(tile * kMaxCandidates + slot) : 0).x);
    vec3 center = fetchTexel(vals, cluster * 3).xyz, normal = fetchTexel(vals, cluster * 3 + 1).xyz, t, b;
    float before = fetchTexel(vals, cluster * 3 + 2).w;  // how far texels stand before the centre, m
    orthonormalBasis(normal, t, b);
    vec3 d = x - center;
    IsmTile map = IsmTile(cluster * int(push.p.ismTileSize * push.p.ismTileSize), int(push.p.ismTileSize));
    float seen = ismHardVisibility(map, vec3(dot(d, t), dot(d, b), dot(d, normal) - before));
    return known ? seen : 1.0;
}
#endif

struct Tap {
    uint texel;
    float weight;  // area of the map the sample stands for, in texels; 0: beyond the map
};

Tap tapOf(RsmFace face, vec2 uv, float texelsPerSample) {
    vec2 at = uv * float(face.size);
    bool inside = all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(face.size)));
    uvec2 coord = face.origin + min(uvec2(max(at, vec2(0.0))), uvec2(face.size - 1));
    return Tap(rsmIndexOfCoord(coord, push.p.atlasWidth), inside ? texelsPerSample : 0.0);
}

vec2 uvOf(RsmFace face, vec3 position, out bool ahead) {
    vec4 clip = face.clipFromWorld * vec4(position, 1.0);
    ahead = clip.w > 0.0;
    return clip.xy / max(clip.w, 1e-6) * 0.5 + 0.5;
}

// Round a point light: the sample's direction picks the face.
Tap pointTap(RsmMap map, vec3 toPixel, vec3 t, vec3 b, vec3 unit) {
    float r = 2.0 * push.p.radius;  // a face is two units wide
    vec3 direction = toPixel + (t * unit.x + b * unit.y) * (r * unit.z);
    float length2 = dot(direction, direction);
    vec3 a = abs(direction);
    float cosAxis = max(a.x, max(a.y, a.z)) * inversesqrt(length2);
    RsmFace face = faces.items[map.firstFace + cubeFace(direction)];
    float solidAngle = kPi * 2.0 * r * r * unit.z * inversesqrt(length2) / length2;
    bool ahead;
    vec2 uv = uvOf(face, map.position + direction, ahead);
    return tapOf(face, uv, solidAngle / perspectiveTexelSolidAngle(1.0, float(face.size), cosAxis));
}

Tap flatTap(RsmFace face, vec2 center, vec3 unit) {
    float r = push.p.radius;
    return tapOf(face, center + unit.xy * (unit.z * r), 2.0 * kPi * r * r * unit.z * float(face.size * face.size));
}

// Cranley & Patterson 1976: the same pattern on a torus, shifted. A pixel's pattern is turned as a whole, with one sine.
struct Shift {
    vec2 by, turn;
};

vec3 shifted(vec4 point, Shift s) {
    vec2 direction = vec2(point.x * s.turn.x - point.y * s.turn.y, point.x * s.turn.y + point.y * s.turn.x);
    return kRandom ? vec3(direction, fract(point.z + s.by.x)) : point.xyz;
}

// Squared radius, in widths of the map, of a disk as large as the pixel is away from what the map sees of it: light from
// closer by has no peak.
float core2Of(RsmFace face, vec2 center, vec3 x) {
    mat4 m = transpose(face.clipFromWorld);
    RsmSurface seen = AG_RSM_FETCH(texels, tapOf(face, center, 1.0).texel);
    vec3 apart = 0.5 * (seen.position - x) / max(dot(m[3], vec4(x, 1.0)), 1e-3);
    float texel = 1.0 / float(face.size), most = push.p.radius * push.p.radius;
    return clamp(dot(apart, apart) * dot(m[0].xyz, m[0].xyz), texel * texel, most);
}

// Half of the samples from the disk, half from the whole map, each weighed by how likely either was to choose it (balance
// heuristic, Veach & Guibas 1995). The disk's are as dense as 1 / (r² + core²), since light falls off so with distance.
// Where the light looks the other way there is no disk.
Tap mixedTap(RsmFace face, vec2 center, bool ahead, vec3 unit, vec2 anywhere, float core2, bool fromDisk) {
    float r2 = push.p.radius * push.p.radius, scale = log2(1.0 + r2 / core2);
    vec2 uv = fromDisk && ahead ? center + unit.xy * sqrt(core2 * (exp2(unit.z * scale) - 1.0)) : anywhere;
    vec2 apart = uv - center;
    float apart2 = dot(apart, apart), disk = apart2 < r2 ? 1.0 / (kPi * log(2.0) * scale * (apart2 + core2)) : 0.0;
    return tapOf(face, uv, float(face.size * face.size) / (ahead ? 0.5 * (1.0 + disk) : 1.0));
}

vec3 gather(vec3 x, vec3 n, vec2 by) {
    RsmMap map = maps.items[push.p.map];
    RsmFace face = faces.items[map.firstFace];
    bool ahead = true;
    vec2 center = vec2(0.0);
    vec3 toPixel = vec3(0.0, 0.0, 1.0), t, b;
    if (kKind == kLightPoint) toPixel = normalize(x - map.position);
    else center = uvOf(face, x, ahead);
    orthonormalBasis(toPixel, t, b);
    float core2 = kWhole && kKind != kLightPoint ? core2Of(face, center, x) : 0.0;
    Shift shift = Shift(by, vec2(cos(2.0 * kPi * by.y), sin(2.0 * kPi * by.y)));
    vec3 e = vec3(0.0);
    for (uint i = 0; i < push.p.sampleCount; ++i) {
        vec4 point = fetchTexel(pattern, int(i));
        vec3 unit = shifted(point, shift);
        Tap tap = kKind == kLightPoint ? pointTap(map, toPixel, t, b, unit)
                  : kWhole             ? mixedTap(face, center, ahead, unit, fract(point.zw + by), core2, i % 2 == 0)
                                       : flatTap(face, center, unit);
        RsmSurface s = AG_RSM_FETCH(texels, tap.texel);
        float term = tap.weight * vplTerm(x, n, s.position, s.normal);
#ifdef AG_VISIBLE
        term *= sampleVisibility(tap.texel, x);
#endif
        e += s.flux * term;
    }
    return ahead || kWhole ? e / float(push.p.sampleCount) : vec3(0.0);
}

void main() {
    uvec2 size = camera.camera.size, stored = uvec2(imageSize(irradiance));
    uint index = gl_GlobalInvocationID.x;
    bool there = index < (kListed ? list.count : stored.x * stored.y);
    uint packed = kListed && there ? list.pixels[index] : 0;
    uvec2 cell = kListed ? uvec2(packed & 0xffffu, packed >> 16) : uvec2(index % stored.x, index / stored.x);
    ivec2 pixel = ivec2(min(cell * push.p.step + push.p.step / 2, size - 1));
    float depth = texelFetch(depthMap, pixel, 0).x;
    vec3 x = worldFromPixel(camera.camera.worldFromClip, size, pixel, depth);
    vec2 by = kRandom ? unpackUnorm2x16(fetchTexel(noise, int((cell.y & 63u) * 64u + (cell.x & 63u))).x) + push.p.shift : vec2(0.0);
    vec3 e = depth > 0.0 ? gather(x, texelFetch(normalMap, pixel, 0).xyz, by) : vec3(0.0);
    if (!there) return;
    if (!kFirst) e += imageLoad(irradiance, ivec2(cell)).rgb;
    imageStore(irradiance, ivec2(cell), vec4(min(e, vec3(kMostHalf)), 1.0));
}
