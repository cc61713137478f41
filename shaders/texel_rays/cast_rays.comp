#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Light that reaches a pixel, by two rays: one to a texel of one area light, drawn by what these are likely to send; one
// into the hemisphere, not far, for light so near that no draw of a texel is even, and from where it ends one to the light.
// Each of both ways counts by how likely either was to find that light (balance heuristic, Veach & Guibas 1995). Texels by
// resampling (Talbot et al. 2005).
#include "common/form_factors.h"
#include "common/pixel_rays.h"
#include "common/sampling.h"
#include "common/texels.glsl"
#include "gbuffer/gbuffer.glsl"
#include "rsm/rsm_io.h"
#include "texel_rays/texel_rays_io.h"
#include "val_clustering/val_clustering_io.h"
#include "val_shading/light_lists.glsl"

const uint kBlockPixels = kDrawBlock * kDrawBlock, kNoLight = ~0u;
layout(local_size_x = kBlockPixels) in;
layout(push_constant, scalar) uniform Push { CastPush p; } push;

layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2, scalar) uniform Camera { CameraConstants camera; } camera;
layout(set = 0, binding = 3) VEC4_TEXELS(texels);
layout(set = 0, binding = 4, scalar) uniform Faces { RsmFace items[kMaxRsmFaces]; } faces;
layout(set = 0, binding = 5, scalar) uniform Maps { RsmMap items[kMaxRsmMaps]; } maps;
layout(set = 0, binding = 6) UINT_TEXELS(lists);
layout(set = 0, binding = 7, scalar) readonly buffer Counts { uvec2 items[]; } counts;
layout(set = 0, binding = 8) FLOAT_TEXELS(upTo);
layout(set = 0, binding = 9) FLOAT_TEXELS(likely);
layout(set = 0, binding = 10) UINT_TEXELS(memberRanges);
layout(set = 0, binding = 11) UINT_TEXELS(members);
layout(set = 0, binding = 12) UINT_TEXELS(slotOfTexel);
layout(set = 0, binding = 13) UINT_TEXELS(candidates);
layout(set = 0, binding = 14) UVEC4_TEXELS(treeNodes);
layout(set = 0, binding = 15, scalar) readonly buffer TreeTriangles { vec4 items[]; } treeTriangles;
layout(set = 0, binding = 16) UVEC4_TEXELS(treePlaces);
layout(set = 0, binding = 17) UVEC4_TEXELS(moverNodes);
layout(set = 0, binding = 18) UINT_TEXELS(noise);  // two 16-bit shares each
// W/m², by the texel drawn; a: 1 + the entry of the light drawn, 0: none.
layout(set = 0, binding = 19, rgba32f) uniform writeonly image2D sent;
layout(set = 0, binding = 20, scalar) buffer Found { RaysFound items[]; } found;  // of each block, by light
layout(set = 0, binding = 21, rgba32f) uniform writeonly image2D sentNear;        // W/m², by the hemisphere's ray

layout(set = 0, binding = 22, scalar) readonly buffer TileMaps { uint items[]; } tileMaps;

#define AG_BVH_MOVERS
#include "bvh/trace.glsl"
#include "texel_rays/blocks.glsl"
#include "rsm/texel_square.glsl"
#include "texel_rays/rsm_lookup.glsl"

const uint kDraws = 8;        // texels that one is resampled from
const float kAlike = 0.8;     // least cosine between normals of a texel and a triangle that receive the same irradiance
const float kResampled = 4.0; // by how much that makes a texel with much to send likelier than drawing one at random
const float kAboutTexel = 2.0; // sides: so far from a texel's middle a ray may meet what it stands for

struct Receiver {
    vec3 position, normal;
    vec3 start;        // of its rays
    float offset;      // m: rays leave so far before it
    uint tile, block;  // of the screen
};

struct Drawn {
    uint entry, light;
    float likely;  // 0: there is no light
};

Drawn drawLight(uint tile, uint block, float xi) {
    uint valCount = push.p.tiles.valCount, first = block * valCount, entries = valCount - push.p.tiles.firstVal;
    uint low = 0, high = max(entries, 1) - 1;
    while (low < high) {
        uint middle = (low + high) / 2;
        bool after = xi >= fetchTexel(upTo, int(first + middle)).x;
        low = after ? middle + 1 : low;
        high = after ? high : middle;
    }
    uint light = entries > 0 ? fetchTexel(lists, int(listEntry(tile, low, counts.items[tile], valCount))).x : 0;
    return Drawn(low, light, entries > 0 ? fetchTexel(likely, int(first + light)).x : 0.0);
}

// Whether the hemisphere's ray may find what a texel stands for. Else a draw has all of it, by its middle.
bool bothFind(Receiver r, uint map, RsmSurface s) {
    return map < push.p.mapCount && distance(s.position, r.position) + kAboutTexel * sqrt(s.area) < push.p.reach;
}

// Share that a draw has of what it and the hemisphere's ray find, by their densities per steradian: the balance heuristic.
float shareOfDraw(Receiver r, vec3 direction, float inSquare, float ofLight, uint memberCount) {
    float draw = ofLight * kResampled / float(max(memberCount, 1)) * inSquare;
    return draw > 0.0 ? draw / (draw + max(dot(r.normal, direction), 0.0) * kInvPi) : 0.0;
}

float factorOf(Receiver r, RsmSurface s) {
    return s.weight > 0.0 ? diskVectorFactor(r.position, r.normal, s.position, s.normal, s.area * kInvPi) / s.area : 0.0;
}

// Mean of the channels of what a texel sends to the receiver if nothing stands between, times about its share.
float wantOf(Receiver r, uint map, RsmSurface s, float ofLight, uint memberCount) {
    float want = factorOf(r, s) * s.weight;
    if (!bothFind(r, map, s)) return want;
    vec3 d = s.position - r.start;
    float d2 = dot(d, d), cosine = -dot(d, s.normal) * inversesqrt(d2);
    return want * max(shareOfDraw(r, d * inversesqrt(d2), d2 / (max(cosine, 1e-4) * s.area), ofLight, memberCount), 1e-3);
}

struct Aim {
    uint texel, map;
    float weight;  // of what the texel sends; 0: there is none
};

Aim aimAt(Receiver r, Drawn d, inout uint random) {
    uint first = fetchTexel(memberRanges, int(d.light * 2)).x, count = fetchTexel(memberRanges, int(d.light * 2 + 1)).x;
    float sum = 0.0, step = float(count) / float(kDraws), wanted = 0.0;
    Aim aim = Aim(kNoTexel, 0, 0.0);
    if (d.likely <= 0.0 || count == 0) return aim;
    uint map = tileMaps.items[fetchTexel(members, int(first)).x / (kRsmTileSize * kRsmTileSize)];
    for (uint i = 0; i < kDraws; ++i) {
        random = hashUint(random);
        uint place = min(uint((float(i) + float(random >> 8) / 16777216.0) * step), count - 1);
        uint texel = fetchTexel(members, int(first + place)).x;
        float want = wantOf(r, map, AG_RSM_FETCH(texels, texel), d.likely, count);
        sum += want;
        random = hashUint(random);
        if (want <= 0.0 || float(random >> 8) / 16777216.0 * sum >= want) continue;
        aim.texel = texel;
        wanted = want;
    }
    return sum > 0.0 ? Aim(aim.texel, map, sum * step / (d.likely * wanted)) : aim;
}

vec3 cosineDirection(vec3 n, vec2 xi) {
    vec3 t, b;
    orthonormalBasis(n, t, b);
    float radius = sqrt(xi.x), angle = 2.0 * kPi * xi.y;
    return t * (radius * cos(angle)) + b * (radius * sin(angle)) + n * sqrt(max(1.0 - xi.x, 0.0));
}

// Whether a map's light reaches a place: a texel says it only about its middle.
bool isLit(RsmMap map, vec3 place, vec3 normal, float offset, float opaqueFrom) {
    vec3 start = place + normal * offset;
    bool sun = map.kind == kLightDirectional;
    BvhRay ray = BvhRay(start, sun ? -map.direction : map.position - start, sun ? 1e20 : 1.0, opaqueFrom, true, 0, 0);
    return !traceOccluders(ray);
}

struct Met {
    vec3 place, normal;  // on the ray's side, unit
    bool front;          // it reflects light to where the ray came from
    vec3 reflectance;    // 0 of a masked triangle
};

Met surfaceMet(BvhRay ray) {
    vec3 normal = normalize(triangleNormal(ray.triangle, ray.place));
    float front = treeTriangles.items[ray.triangle * 3 + 2].w;
    bool behind = dot(normal, ray.direction) > 0.0;
    bool whole = treeTriangles.items[ray.triangle * 3].w >= 1.0;
    vec3 reflectance = unpackReflectance(treeTriangles.items[ray.triangle * 3 + 1].w);
    return Met(ray.origin + ray.direction * ray.reach, behind ? -normal : normal, front == 0.0 || (front < 0.0) == behind,
               whole ? reflectance : vec3(0.0));
}

// What a map's light makes a place send, W/m², if it is lit. Beside a crease and on what is narrower than a texel no
// texel stands for the place: then the triangle's reflectance says it. Not so for masked triangles: they have few texels
// because light passes through them.
struct Sender {
    uint texel;  // kNoTexel: no draw finds it
    vec3 sends;
};

Sender senderAt(uint map, Met met) {
    uint texel = texelAt(map, push.p.atlasWidth, met.place, met.normal);
    texel = texel != kNoTexel && fetchTexel(slotOfTexel, int(texel)).x == kNoCluster ? kNoTexel : texel;
    if (texel != kNoTexel) {
        RsmSurface s = AG_RSM_FETCH(texels, texel);
        if (dot(s.normal, met.normal) >= kAlike || met.reflectance == vec3(0.0)) return Sender(texel, s.flux / s.area);
    }
    return Sender(texel, irradianceOf(maps.items[map], met.place, met.normal) * met.reflectance);
}

// Weight of what the hemisphere's ray found: the rest of the draws'.
float weightOfNear(Receiver r, uint map, uint texel, vec3 direction) {
    if (texel == kNoTexel) return 1.0;
    TexelView v = viewTexel(texel, map, push.p.atlasWidth);
    if (!bothFind(r, map, v.s)) return 0.0;
    SquareCrossing c = crossSquare(v, r.start, direction);
    if (!inSquare(c.aside) || factorOf(r, v.s) <= 0.0) return 1.0;
    uint slot = fetchTexel(slotOfTexel, int(texel)).x;
    uint light = fetchTexel(candidates, int(texel / (kRsmTileSize * kRsmTileSize) * kMaxCandidates + slot)).x;
    uint memberCount = fetchTexel(memberRanges, int(light * 2 + 1)).x;
    float ofLight = fetchTexel(likely, int(r.block * push.p.tiles.valCount + light)).x;
    return 1.0 - shareOfDraw(r, direction, c.density, ofLight, memberCount);
}

// A ray, what it counts, and the maps whose light it asks for.
struct Way {
    BvhRay ray;
    float weight;
    uint firstMap, endMap;
};

Way wayOfNear(Receiver r, vec2 xi, float opaqueFrom) {
    return Way(BvhRay(r.start, cosineDirection(r.normal, xi), push.p.reach, opaqueFrom, false, 0, 0), 1.0, 0, push.p.mapCount);
}

// Close by through a place of the texel's square, for light comes from what the ray meets; farther away to its middle.
Way wayOfDraw(Receiver r, Drawn d, Aim aim, vec2 xi, float opaqueFrom, out vec3 unlessMet) {
    TexelView v = viewTexel(aim.texel, aim.map, push.p.atlasWidth);
    bool both = bothFind(r, aim.map, v.s);
    vec3 middle = v.s.position + v.s.normal * max(push.p.offset, push.p.texelOffset * sqrt(v.s.area)) - r.start;
    vec3 toward = both ? onPlaneAside(v, xi - 0.5) - r.start : middle;
    float far = length(toward);
    vec3 direction = toward / max(far, 1e-9);
    unlessMet = both ? vec3(0.0) : v.s.flux * (factorOf(r, v.s) * aim.weight);
    if (!both) return Way(BvhRay(r.start, direction, far, opaqueFrom, true, 0, 0), 0.0, 0, 0);
    uint memberCount = fetchTexel(memberRanges, int(d.light * 2 + 1)).x;
    float density = crossSquare(v, r.start, direction).density, cosine = dot(r.normal, direction);
    float share = shareOfDraw(r, direction, density, d.likely, memberCount);
    float weight = density > 0.0 ? aim.weight * share * max(cosine, 0.0) * kInvPi / density : 0.0;
    float reach = far + kAboutTexel * sqrt(v.s.area);
    return Way(BvhRay(r.start, direction, reach, opaqueFrom, false, 0, 0), weight, aim.map, aim.map + 1);
}

// W/m².
vec3 sentAlong(Receiver r, Way w, bool drawn, uint aimedAt) {
    Met met = surfaceMet(w.ray);
    vec3 e = vec3(0.0);
    for (uint map = w.firstMap; map < w.endMap && met.front; ++map) {
        Sender from = senderAt(map, met);
        float weight = drawn ? (from.texel == aimedAt ? w.weight : 0.0) : weightOfNear(r, map, from.texel, w.ray.direction);
        vec3 sends = from.sends * weight;
        bool some = sends.x + sends.y + sends.z > 0.0;
        if (some && isLit(maps.items[map], met.place, met.normal, r.offset, w.ray.opaqueFrom)) e += sends;
    }
    return e;
}

vec2 noiseAt(uvec2 pixel, uint aside) {
    return unpackUnorm2x16(fetchTexel(noise, int((pixel.y & 63u) * 64u + (pixel.x + aside & 63u))).x);
}

// Of a block: four by two for each eight invocations in a row.
uvec2 placeInBlock(uint i) { return uvec2((i & 3u) | (i >> 1 & 4u), (i >> 2 & 1u) | (i >> 3 & 6u)); }

// What each pixel of the block drew and found.
shared uint drawnOf[kBlockPixels];  // kNoLight: nothing
shared float squareOf[kBlockPixels];

// By one invocation in the order of pixels, so that sums are the same in every run.
void noteFound(uint block, Drawn d, float sends) {
    drawnOf[gl_LocalInvocationID.x] = d.likely > 0.0 ? d.light : kNoLight;
    squareOf[gl_LocalInvocationID.x] = sends * sends;
    barrier();
    if (gl_LocalInvocationID.x > 0) return;
    for (uint i = 0; i < kBlockPixels; ++i) {
        if (drawnOf[i] == kNoLight) continue;
        uint at = block * push.p.tiles.valCount + drawnOf[i];
        found.items[at].count += 1.0;
        found.items[at].squares += squareOf[i];
    }
}

// A block a workgroup.
void main() {
    uvec2 size = camera.camera.size;
    uint block = gl_WorkGroupID.x;
    uvec2 cell = blockOrigin(block, size) + placeInBlock(gl_LocalInvocationID.x);
    ivec2 pixel = ivec2(min(cell, size - 1u));
    bool there = all(equal(uvec2(pixel), cell));
    uvec2 tile = uvec2(pixel) / push.p.tiles.tileSize;
    float depth = texelFetch(depthMap, pixel, 0).x;
    mat4 worldFromClip = camera.camera.worldFromClip;
    vec3 position = worldFromPixel(worldFromClip, size, pixel, depth);
    float wide = distance(position, worldFromPixel(worldFromClip, size, pixel + ivec2(1, 0), depth));
    float offset = max(push.p.offset, push.p.pixelOffset * wide);
    // Nearer to the camera, which sees it: in a crease rounding may put it behind the other surface.
    position += normalize(camera.camera.position - position) * offset;
    vec3 normal = texelFetch(normalMap, pixel, 0).xyz;
    uint inTiles = tile.y * push.p.tiles.tiles.x + tile.x;
    Receiver r = Receiver(position, normal, position + normal * offset, offset, inTiles, block);
    uint random = hashUint(uint(pixel.x) + uint(pixel.y) * 65536u + hashUint(push.p.ray) * 31u);
    vec3 xi = fract(vec3(noiseAt(cell, 0u), noiseAt(cell, 32u).x) + push.p.shift);
    Drawn d = drawLight(r.tile, r.block, xi.z);
    d.likely = depth > 0.0 ? d.likely : 0.0;
    Aim aim = aimAt(r, d, random);
    float opaqueFrom = float(random >> 8) / 16777216.0;
    vec2 inSquare = vec2(hashUint(random) >> 8, hashUint(random ^ 0x9e3779b9u) >> 8) / 16777216.0;
    vec3 found[2] = vec3[2](vec3(0.0), vec3(0.0));
    for (uint i = 0; i < 2; ++i) {
        bool drawn = i == 0;
        if (depth == 0.0 || drawn && aim.weight == 0.0) continue;
        Way w;
        if (drawn) w = wayOfDraw(r, d, aim, inSquare, opaqueFrom, found[0]);
        else w = wayOfNear(r, xi.xy, opaqueFrom);
        if (traceOccluders(w.ray)) found[i] = sentAlong(r, w, drawn, aim.texel);
    }
    vec3 e = found[0], near = found[1];
    float sends = luminance(e) * d.likely;
    d.likely = there ? d.likely : 0.0;
    if (there) {
        imageStore(sent, pixel, vec4(e, d.likely > 0.0 ? float(d.entry + 1) : 0.0));
        imageStore(sentNear, pixel, vec4(near, 0.0));
    }
    noteFound(block, d, sends);
}
