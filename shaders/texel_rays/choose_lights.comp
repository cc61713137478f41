#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// How likely a pixel of a block of the screen is to draw each area light: by the root of the mean square of what the
// block's rays to it have found, which makes the variance least. Before there are many, by what it sends to some of the
// block's pixels, as disks through their imperfect shadow maps, and a little more, for these may be wrong. One group of
// lanes a block.
#include "common/lanes.glsl"
#include "common/pixel_rays.h"
layout(constant_id = 0) const uint kShape = 2;
layout(constant_id = 1) const int kVisibilityTaps = 1;
#include "common/texels.glsl"
layout(set = 0, binding = 3) VEC4_TEXELS(vals);
layout(set = 0, binding = 4) VEC4_TEXELS(shapes);
layout(set = 0, binding = 5) VEC4_TEXELS(isms);
layout(set = 0, binding = 6) UINT_TEXELS(lists);
#include "gbuffer/gbuffer.glsl"
#include "texel_rays/texel_rays_io.h"
#include "val_shading/area_light.glsl"
#include "val_shading/light_lists.glsl"

layout(push_constant, scalar) uniform Push { ChoosePush p; } push;
layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2, scalar) uniform Camera { CameraConstants camera; } camera;
layout(set = 0, binding = 7, scalar) readonly buffer Counts { uvec2 items[]; } counts;
// Of its tile's near lights, far ones and the rest: how likely one is up to and with each.
layout(set = 0, binding = 8, scalar) buffer UpTo { float items[]; } upTo;
layout(set = 0, binding = 9, scalar) buffer Likely { float items[]; } likely;  // of each light of all
layout(set = 0, binding = 10, scalar) readonly buffer FoundBefore { RaysFound items[]; } foundBefore;
layout(set = 0, binding = 11, scalar) writeonly buffer Found { RaysFound items[]; } found;
#include "texel_rays/blocks.glsl"

const uint kPlaces = 4;       // 2 x 2
const float kUnseen = 0.1;    // share of its light that counts where its map says it is not seen
const float kAnywhere = 0.05; // and of what it would send if surface and light faced each other
const float kExpected = 0.25;  // rays that what is expected counts for: little, maps are most wrong where light is rare
const float kEvenly = 0.1;    // of draws, whatever lights send: pixels about may be very different
shared vec4 places[kPlaces], normals[kPlaces];  // w: 0: no surface

void findPlaces(uint block, uvec2 origin) {
    const uint kCell = kDrawBlock / 2;
    uvec2 size = camera.camera.size;
    for (uint i = laneIndex(); i < kPlaces; i += kLanes) {
        uint r = hashUint(block * kPlaces + i + push.p.ray * 0x9e3779b9u);
        uvec2 inCell = uvec2(r & 0xffffu, r >> 16) * kCell >> 16;
        ivec2 pixel = ivec2(min(origin + uvec2(i & 1u, i >> 1) * kCell + inCell, size - 1));
        float depth = texelFetch(depthMap, pixel, 0).x;
        places[i] = vec4(worldFromPixel(camera.camera.worldFromClip, size, pixel, depth), depth > 0.0 ? 1.0 : 0.0);
        normals[i] = vec4(texelFetch(normalMap, pixel, 0).xyz, 0.0);
    }
    laneBarrier();
}

// Luminance, W/m².
float expectedOf(AreaLight l, uint ismTileSize) {
    LightFrame f = frameOf(l);
    float sum = 0.0, count = 0.0;
    for (uint i = 0; i < kPlaces; ++i) {
        if (places[i].w == 0.0) continue;
        count += 1.0;
        vec3 x = places[i].xyz, d = x - l.place.xyz;
        float seen = kUnseen + (1.0 - kUnseen) * visibility(x, l, f, ismTileSize);
        sum += shapeTerm(x, normals[i].xyz, 0.0, l, f) * seen + kAnywhere * l.place.w / (dot(d, d) + l.place.w);
    }
    return sum / max(count, 1.0) * luminance(l.power.rgb);
}

// Keeps what is known, or as much of it as shall be remembered.
float weightOf(uint entry, AreaLight l, uint ismTileSize) {
    float count = push.p.known == 1 ? foundBefore.items[entry].count : 0.0;
    float squares = push.p.known == 1 ? foundBefore.items[entry].squares : 0.0;
    float kept = min(1.0, push.p.mostKnown / max(count, 1.0)), expected = expectedOf(l, ismTileSize);
    count *= kept, squares *= kept;
    found.items[entry].count = count;
    found.items[entry].squares = squares;
    return sqrt((kExpected * expected * expected + squares) / (kExpected + count));
}

void main() {
    uint block = gl_WorkGroupID.x, valCount = push.p.tiles.valCount;
    uvec2 origin = blockOrigin(block, camera.camera.size), inTiles = origin / push.p.tiles.tileSize;
    uint tile = inTiles.y * push.p.tiles.tiles.x + inTiles.x;
    findPlaces(block, origin);
    uvec2 count = counts.items[tile];
    uint entries = valCount - push.p.tiles.firstVal, first = block * valCount, lit = 0;
    float total = 0.0;
    for (uint base = 0; base < entries; base += kLanes) {
        uint entry = base + laneIndex(), asked = min(entry, entries - 1);
        uint light = fetchTexel(lists, int(listEntry(tile, asked, count, valCount))).x;
        float weight = weightOf(first + light, loadLight(light), push.p.tiles.ismTileSize);
        weight = entry < entries ? weight : 0.0;
        total += laneAdd(weight);
        lit += laneVote(weight > 0.0).count;
        if (entry < entries) upTo.items[first + entry] = weight;
    }
    float before = 0.0, share = lit > 0 ? (1.0 - kEvenly) / total : 0.0, evenly = kEvenly / float(max(lit, 1));
    for (uint base = 0; base < entries; base += kLanes) {
        uint entry = base + laneIndex();
        float sends = entry < entries ? upTo.items[first + entry] : 0.0;
        float weight = sends > 0.0 ? sends * share + evenly : 0.0;
        float end = before + laneInclusiveAdd(weight);
        before += laneAdd(weight);
        if (entry >= entries) continue;
        upTo.items[first + entry] = end;
        likely.items[first + fetchTexel(lists, int(listEntry(tile, entry, count, valCount))).x] = weight;
    }
}
