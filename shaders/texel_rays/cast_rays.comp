#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Light that reaches a pixel, by two rays: one to a texel of one area light, drawn by what these are likely to send
// (resampling, Talbot et al. 2005); one into the hemisphere, not far. Within the reach of the second, both count the light of
// the surface they meet, and a further ray asks whether the light gets there. Near points of later bounces, the light of area
// lights and of the sky goes on from where the second ends, by a ray to either.
#include "common/pixel_rays.h"
#include "common/random.glsl"
#include "common/texels.glsl"
#include "gbuffer/gbuffer.glsl"
#include "later_bounces/later_bounces_io.h"
#include "rsm/rsm_io.h"
#include "sky/sky_io.h"
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
layout(set = 0, binding = 18, scalar) uniform Noise { uvec4 items[1024]; } noise;  // two 16-bit shares each
// W/m², by what was drawn; a: 1 + the entry of the light drawn, 0: none.
layout(set = 0, binding = 19, rgba32f) uniform writeonly image2D sent;
layout(set = 0, binding = 20, scalar) buffer FoundByLight { RaysFound items[]; } found;  // of each block, by light
layout(set = 0, binding = 21, rgba32f) uniform writeonly image2D sentNear;        // W/m², by the hemisphere's ray
layout(set = 0, binding = 22, scalar) readonly buffer TileMaps { uint items[]; } tileMaps;
layout(set = 0, binding = 23) VEC4_TEXELS(skyTexels);
layout(set = 0, binding = 24, scalar) uniform SkyUpTo { vec4 items[kSkyCells / 4]; } skyUpTo;
layout(set = 0, binding = 25) uniform sampler2D rsmNormals;
layout(set = 0, binding = 26) uniform sampler2D rsmAlbedos;
layout(constant_id = 0) const bool kSky = false;
layout(constant_id = 1) const bool kTexelLobes = false;

#define AG_BVH_MOVERS
#include "bvh/trace.glsl"
#include "texel_rays/blocks.glsl"
#include "texel_rays/met_surface.glsl"
#include "gbuffer/pixel_start.glsl"
#include "texel_rays/ray_weights.glsl"
#define AG_SKY_UP_TO(cell) skyUpTo.items[(cell) / 4][(cell) % 4]
#include "texel_rays/incident.glsl"

const uint kDraws = 8, kNearDraws = 16;  // texels that one is resampled from: of a light; of all for what is near

struct Drawn {
    uint entry, light;
    float likely;  // 0: there is no light
    uint memberCount;
    float chance;  // of one of its texels
};

uint entriesOfLists() { return push.p.tiles.valCount - push.p.tiles.firstVal; }

Drawn lightOfEntry(uint tile, uint block, uint entry) {
    uint valCount = push.p.tiles.valCount;
    bool some = entriesOfLists() > 0;
    uint light = some ? fetchTexel(lists, int(listEntry(tile, entry, counts.items[tile], valCount))).x : 0;
    float likely_ = some ? fetchTexel(likely, int(block * valCount + light)).x : 0.0;
    // Lights that stand for no cluster send nothing, and have no members.
    uint memberCount = fetchTexel(memberRanges, int(likely_ > 0.0 ? light * 2 + 1 : 1)).x;
    return Drawn(entry, light, likely_, memberCount, chanceOfTexel(likely_, memberCount));
}

Drawn drawLight(uint tile, uint block, float xi) {
    uint first = block * push.p.tiles.valCount, low = 0, high = max(entriesOfLists(), 1) - 1;
    while (low < high) {
        uint middle = (low + high) / 2;
        bool after = xi >= fetchTexel(upTo, int(first + middle)).x;
        low = after ? middle + 1 : low;
        high = after ? high : middle;
    }
    return lightOfEntry(tile, block, low);
}

struct TexelAim {
    uint texel, map;
    float weight;  // of what the texel sends; 0: there is none
};

TexelAim aimAt(Receiver r, Drawn d, inout uint random) {
    TexelAim aim = TexelAim(kNoTexel, 0, 0.0);
    if (d.likely <= 0.0 || d.memberCount == 0) return aim;
    uint first = firstMember(d.light);
    aim.map = tileMaps.items[fetchTexel(members, int(first)).x / (kRsmTileSize * kRsmTileSize)];
    MemberDraw drawn = MemberDraw(kNoTexel, 0.0, 0.0);
    AG_DRAW_MEMBER(drawn, first, d.memberCount, kDraws, random, wantOf(r, aim.map, s, d.chance) * meanOf(sentTo(r.position, texel_, s, push.p.atlasWidth)))
    aim.texel = drawn.texel;
    aim.weight = weightOf(drawn, d.memberCount, kDraws) / d.likely;
    return aim;
}

// A ray, and the maps whose light it asks for where it ends.
struct Way {
    BvhRay ray;
    uint firstMap, endMap;
    uint texel;      // kNoTexel: it counts whatever it meets
    float weight;    // else of what is met there if this one stands for it
    vec3 unblocked;  // W/m², if it meets nothing
};

Way wayOfNear(Receiver r, vec2 xi, float opaqueFrom) {
    BvhRay ray = BvhRay(r.start, cosineDirection(r.normal, xi), push.p.reach, opaqueFrom, false, 0, 0);
    return Way(ray, 0, push.p.mapCount, kNoTexel, 0.0, vec3(0.0));
}

// To a texel's middle: all it sends if nothing stands between.
Way wayToMiddle(Receiver r, TexelView v, TexelAim aim, float opaqueFrom) {
    BvhRay ray = BvhRay(r.start, endBefore(v.s) - r.start, 1.0, opaqueFrom, true, 0, 0);
    vec3 sends = v.s.flux * sentTo(r.position, aim.texel, v.s, push.p.atlasWidth);
    return Way(ray, 0, 0, aim.texel, 0.0, sends * (drawnFactorOf(r, aim.map, v.s) * aim.weight));
}

// Through a place of its square: the light of what is met there.
Way wayThroughSquare(Receiver r, TexelView v, Drawn d, TexelAim aim, vec2 xi, float opaqueFrom) {
    vec3 toward = onPlaneAside(v, xi - 0.5) - r.start;
    float far = length(toward);
    vec3 direction = toward / max(far, 1e-9);
    float density = crossSquare(v, r.start, direction).density, cosine = max(dot(r.normal, direction), 0.0);
    float share = shareOfDraw(r, direction, density, d.chance);
    float weight = density > 0.0 ? aim.weight * share * cosine * kInvPi / density : 0.0;
    BvhRay ray = BvhRay(r.start, direction, far + kAboutTexel * sqrt(v.s.area), opaqueFrom, false, 0, 0);
    return Way(ray, aim.map, aim.map + 1, aim.texel, weight, vec3(0.0));
}

Way wayOfDraw(Receiver r, Drawn d, TexelAim aim, vec2 xi, float opaqueFrom) {
    TexelView v = viewTexel(aim.texel, aim.map, push.p.atlasWidth);
    if (bothFind(r, aim.map, v.s)) return wayThroughSquare(r, v, d, aim, xi, opaqueFrom);
    return wayToMiddle(r, v, aim, opaqueFrom);
}

uint memberAt(uint first, uint count, float xi) { return fetchTexel(members, int(first + min(uint(xi * float(count)), count - 1))).x; }

struct Candidate {
    uint texel;
    float likely;
};

// A texel that may light a place near the pixel: of one of the pixel's lights, by what is likely for the pixel or any; or of
// those before them, which the layer leaves out.
Candidate candidateFor(Receiver r, inout uint random) {
    const float kEven = 0.5;
    uint others = push.p.tiles.firstVal > 0 ? firstMember(push.p.tiles.firstVal) - firstMember(0) : 0, entries = entriesOfLists();
    float ofBefore = others > 0 ? 0.5 : 0.0;
    if (next(random) < ofBefore) return Candidate(memberAt(firstMember(0), others, next(random)), ofBefore / float(others));
    bool even = next(random) < kEven;
    float xi = next(random);
    Drawn d = even ? lightOfEntry(r.tile, r.block, min(uint(xi * float(entries)), max(entries, 1) - 1)) : drawLight(r.tile, r.block, xi);
    if (entries == 0 || d.memberCount == 0 || d.likely <= 0.0) return Candidate(kNoTexel, 0.0);
    float ofLight = mix(d.likely, 1.0 / float(entries), kEven);
    return Candidate(memberAt(firstMember(d.light), d.memberCount, next(random)), (1.0 - ofBefore) * ofLight / float(d.memberCount));
}

Incident fromAreaLights(Receiver r, inout uint random) {
    MemberDraw drawn = MemberDraw(kNoTexel, 0.0, 0.0);
    for (uint i = 0; i < kNearDraws; ++i) {
        Candidate c = candidateFor(r, random);
        if (c.texel == kNoTexel) continue;
        RsmSurface s = AG_RSM_FETCH(texels, c.texel);
        float want = drawnFactorOf(r, mapOfTexel(c.texel), s) * s.weight * meanOf(sentTo(r.position, c.texel, s, push.p.atlasWidth));
        take(drawn, c.texel, want, want / c.likely, random);
    }
    if (drawn.texel == kNoTexel) return kNoIncident;
    RsmSurface s = AG_RSM_FETCH(texels, drawn.texel);
    vec3 sends = s.flux * sentTo(r.position, drawn.texel, s, push.p.atlasWidth);
    return Incident(endBefore(s) - r.start, 1.0, sends * (drawnFactorOf(r, mapOfTexel(drawn.texel), s) * weightOf(drawn, 1, kNearDraws)));
}

Receiver pixel;

Incident drawOnto(vec3 place, vec3 normal, inout uint random) {
    return fromAreaLights(Receiver(place, normal, place + normal * push.p.offset, push.p.offset, pixel.tile, pixel.block), random);
}

#define AG_ON_KINDS 1
#define AG_ON_DRAW(kind, place, normal, random) drawOnto(place, normal, random)
#define AG_ON_SHINES (push.p.emissiveMap < kMaxRsmMaps ? push.p.emissiveReach : 0.0)
#define AG_ON_REFLECTS (push.p.laterMap < kMaxRsmMaps ? push.p.laterReach : 0.0)
#include "texel_rays/near_path.glsl"

struct Found {
    vec3 e;   // W/m², of what the ray met or was drawn to
    vec3 on;  // the same of light that goes on from there, by another draw
};

Found sentAlong(Receiver r, Way w, uint random) {
    if (!traceOccluders(w.ray)) return Found(w.unblocked, vec3(0.0));
    Met met = surfaceMet(w.ray);
    if (!met.front) return Found(vec3(0.0), vec3(0.0));
    bool near = w.texel == kNoTexel;
    vec3 e = near ? met.shines * nearShare(w.ray.reach, AG_ON_SHINES) : vec3(0.0);
    for (uint map = w.firstMap; map < w.endMap; ++map) {
        Sender from = senderAt(map, met, w.ray, push.p.atlasWidth);
        float ofDraw = from.texel == w.texel ? w.weight : 0.0;
        vec3 sends = from.sends * (near ? shareOfNear(r, map, from.texel, w.ray.direction) : ofDraw);
        bool some = sends.x + sends.y + sends.z > 0.0;
        if (some && isLit(maps.items[map], met, r.offset, w.ray.opaqueFrom)) e += sends;
    }
    return Found(e, near ? lightFrom(met, sendsOn(met, w.ray.reach), w.ray.opaqueFrom, random) : vec3(0.0));
}

vec2 noiseAt(uvec2 pixel, uint aside) {
    uint i = (pixel.y & 63u) * 64u + (pixel.x + aside & 63u);
    return unpackUnorm2x16(noise.items[i / 4][i % 4]);
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
    ivec2 at = ivec2(min(cell, size - 1u));
    bool there = all(equal(uvec2(at), cell));
    uvec2 tile = uvec2(at) / push.p.tiles.tileSize;
    float depth = texelFetch(depthMap, at, 0).x;
    PixelStart start = startOf(at, depth);
    vec3 normal = texelFetch(normalMap, at, 0).xyz;
    uint inTiles = tile.y * push.p.tiles.tiles.x + tile.x;
    Receiver r = Receiver(start.place, normal, start.place + normal * start.offset, start.offset, inTiles, block);
    pixel = r;
    uint random = hashUint(uint(at.x) + uint(at.y) * 65536u + hashUint(push.p.ray) * 31u);
    vec3 xi = fract(vec3(noiseAt(cell, 0u), noiseAt(cell, 32u).x) + push.p.shift);
    Drawn d = drawLight(r.tile, r.block, xi.z);
    d.likely = depth > 0.0 ? d.likely : 0.0;
    TexelAim aim = aimAt(r, d, random);
    float opaqueFrom = unitOf(random);
    vec2 placeInSquare = vec2(hashToUnit(random), hashToUnit(random ^ 0x9e3779b9u));
    Found byWay[2] = Found[2](Found(vec3(0.0), vec3(0.0)), Found(vec3(0.0), vec3(0.0)));
    // A loop, so that the trees' walk is compiled once.
    for (uint i = 0; i < 2; ++i) {
        bool draws = i == 0;
        if (depth == 0.0 || draws && aim.weight == 0.0) continue;
        Way w;
        if (draws) w = wayOfDraw(r, d, aim, placeInSquare, opaqueFrom);
        else w = wayOfNear(r, xi.xy, opaqueFrom);
        byWay[i] = sentAlong(r, w, random);
    }
    float sends = luminance(byWay[0].e) * d.likely;
    d.likely = there ? d.likely : 0.0;
    if (there) {
        imageStore(sent, at, vec4(byWay[0].e + byWay[1].on, d.likely > 0.0 ? float(d.entry + 1) : 0.0));
        imageStore(sentNear, at, vec4(byWay[1].e, 0.0));
    }
    noteFound(block, d, sends);
}
