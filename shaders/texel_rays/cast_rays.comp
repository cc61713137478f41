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

#define AG_BVH_MOVERS
#include "bvh/trace.glsl"
#include "texel_rays/blocks.glsl"
#include "texel_rays/rsm_lookup.glsl"

const uint kDraws = 8;        // texels that one is resampled from
const float kNearSides = 1.0; // of a texel: so near light is found by the hemisphere's ray alone
const float kOwnSides = 0.7;  // of a texel: farther from its middle, a place is not on the texel's own surface
const float kAlike = 0.8;     // least cosine between normals of a texel and a triangle that receive the same irradiance
const float kResampled = 4.0; // by how much that makes a texel with much to send likelier than drawing one at random

struct Receiver {
    vec3 position, normal;
    float offset;      // m: rays leave so far before it
    uint tile, block;  // of the screen
};

// Of a texel, by drawing its light and then one of its members: per steradian at the receiver.
float densityOfDraw(float ofLight, uint memberCount, RsmSurface s, vec3 toTexel) {
    float d2 = max(dot(toTexel, toTexel), 1e-12), cosine = -dot(s.normal, toTexel) * inversesqrt(d2);
    return cosine > 0.0 ? ofLight * kResampled / float(max(memberCount, 1)) * d2 / (max(cosine, 1e-4) * s.area) : 0.0;
}

// Weight of the hemisphere's ray for light from a texel: the balance heuristic; 1 close to the texel, whose middle is there a
// poor guess of where its light comes from, and 1 where the middle is below the horizon, so that no draw finds it. Draws
// have the rest. Both evaluate this at the texel's middle, so that the two weights add up to 1.
float shareOfHemisphere(Receiver r, RsmSurface s, float ofLight, uint memberCount) {
    vec3 toTexel = s.position - r.position;
    float d = length(toTexel), own = dot(r.normal, toTexel) / max(d, 1e-6) * kInvPi;
    if (d >= push.p.reach) return 0.0;
    if (own <= 0.0) return 1.0;
    float draw = densityOfDraw(ofLight, memberCount, s, toTexel);
    return mix(1.0, own / (draw + own), smoothstep(kNearSides, 2.0 * kNearSides, d * inversesqrt(s.area)));
}

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

// Mean of the channels of what a texel sends to the receiver if nothing stands between, times its weight against the
// hemisphere's ray.
float wantOf(Receiver r, RsmSurface s, float ofLight, uint memberCount) {
    float factor = diskVectorFactor(r.position, r.normal, s.position, s.normal, s.area * kInvPi);
    return factor * s.weight / s.area * (1.0 - shareOfHemisphere(r, s, ofLight, memberCount));
}

vec3 sentByDrawn(Receiver r, Drawn d, inout uint random, out vec3 toTexel) {
    uint first = fetchTexel(memberRanges, int(d.light * 2)).x, count = fetchTexel(memberRanges, int(d.light * 2 + 1)).x;
    uint chosen = 0;
    float sum = 0.0, step = float(count) / float(kDraws);
    toTexel = vec3(0.0);
    if (d.likely <= 0.0 || count == 0) return vec3(0.0);
    for (uint i = 0; i < kDraws; ++i) {
        random = hashUint(random);
        uint place = min(uint((float(i) + float(random >> 8) / 16777216.0) * step), count - 1);
        uint texel = fetchTexel(members, int(first + place)).x;
        float want = wantOf(r, AG_RSM_FETCH(texels, texel), d.likely, count);
        sum += want;
        random = hashUint(random);
        if (want > 0.0 && float(random >> 8) / 16777216.0 * sum < want) chosen = texel;
    }
    if (sum <= 0.0) return vec3(0.0);
    RsmSurface s = AG_RSM_FETCH(texels, chosen);
    toTexel = s.position + s.normal * max(push.p.offset, push.p.texelOffset * sqrt(s.area)) - r.position;
    return s.flux / s.weight * (sum * step / d.likely);
}

bool isSeen(Receiver r, vec3 toTexel, float opaqueFrom) {
    vec3 start = r.normal * r.offset;
    BvhRay ray = BvhRay(r.position + start, toTexel - start, 1.0, opaqueFrom, true, 0, 0);
    return !traceOccluders(ray);
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

// A map's light from what the hemisphere's ray met, W/m². Beside a crease and on what is narrower than a texel no texel
// stands for the place. Draws miss it, so the weight is 1, and the triangle's reflectance says what it sends. Not so for
// masked triangles: they have few texels because light passes through them.
vec3 sentFrom(Receiver r, uint map, Met met, float opaqueFrom) {
    uint texel = texelAt(map, push.p.atlasWidth, met.place, met.normal);
    uint slot = texel == kNoTexel ? kNoCluster : fetchTexel(slotOfTexel, int(texel)).x;
    bool byTexel = slot != kNoCluster;
    float share = 1.0;
    vec3 sends;
    if (byTexel) {
        RsmSurface s = AG_RSM_FETCH(texels, texel);
        sends = s.flux / s.area;
        byTexel = dot(s.normal, met.normal) >= kAlike || met.reflectance == vec3(0.0);
        vec3 apart = met.place - s.position;
        if (dot(apart, apart) > kOwnSides * kOwnSides * s.area) s.position = met.place;
        uint light = fetchTexel(candidates, int(texel / (kRsmTileSize * kRsmTileSize) * kMaxCandidates + slot)).x;
        uint memberCount = fetchTexel(memberRanges, int(light * 2 + 1)).x;
        float ofLight = fetchTexel(likely, int(r.block * push.p.tiles.valCount + light)).x;
        share = shareOfHemisphere(r, s, ofLight, memberCount);
    }
    if (!byTexel) sends = irradianceOf(maps.items[map], met.place, met.normal) * met.reflectance;
    sends *= share;
    bool some = sends.x + sends.y + sends.z > 0.0;
    return some && isLit(maps.items[map], met.place, met.normal, r.offset, opaqueFrom) ? sends : vec3(0.0);
}

vec3 sentByNear(Receiver r, vec2 xi, float opaqueFrom) {
    BvhRay ray = BvhRay(r.position + r.normal * r.offset, cosineDirection(r.normal, xi), push.p.reach, opaqueFrom, false, 0, 0);
    if (!traceOccluders(ray)) return vec3(0.0);
    Met met = surfaceMet(ray);
    vec3 e = vec3(0.0);
    for (uint map = 0; map < push.p.mapCount && met.front; ++map) e += sentFrom(r, map, met, opaqueFrom);
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
    Receiver r = Receiver(position, texelFetch(normalMap, pixel, 0).xyz, offset, tile.y * push.p.tiles.tiles.x + tile.x, block);
    uint random = hashUint(uint(pixel.x) + uint(pixel.y) * 65536u + hashUint(push.p.ray) * 31u);
    vec3 xi = fract(vec3(noiseAt(cell, 0u), noiseAt(cell, 32u).x) + push.p.shift);
    Drawn d = drawLight(r.tile, r.block, xi.z);
    d.likely = depth > 0.0 ? d.likely : 0.0;
    vec3 toTexel, e = sentByDrawn(r, d, random, toTexel);
    float opaqueFrom = float(random >> 8) / 16777216.0;
    if (e.x + e.y + e.z > 0.0 && !isSeen(r, toTexel, opaqueFrom)) e = vec3(0.0);
    float sends = luminance(e) * d.likely;
    vec3 near = depth > 0.0 ? sentByNear(r, xi.xy, opaqueFrom) : vec3(0.0);
    d.likely = there ? d.likely : 0.0;
    if (there) {
        imageStore(sent, pixel, vec4(e, d.likely > 0.0 ? float(d.entry + 1) : 0.0));
        imageStore(sentNear, pixel, vec4(near, 0.0));
    }
    noteFound(block, d, sends);
}
