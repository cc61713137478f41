#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// For each tile of the screen the lights whose range reaches into the boxes round its near and far surfaces, in ascending
// order, by one group of lanes a tile.
#include "common/lanes.glsl"
#include "common/texels.glsl"
#include "direct_lighting/direct_lighting_io.h"
#include "gbuffer/gbuffer.glsl"

layout(push_constant, scalar) uniform Push { PunctualPush p; } push;

layout(constant_id = 0) const bool kByRange = true;  // false: all lights everywhere
layout(set = 0, binding = 0) uniform sampler2D depthMap;
layout(set = 0, binding = 1, scalar) uniform Camera { CameraConstants camera; } camera;
layout(set = 0, binding = 2) VEC4_TEXELS(lights);
layout(set = 0, binding = 3, scalar) writeonly buffer Lists { uint items[]; } lists;
layout(set = 0, binding = 4, scalar) writeonly buffer Counts { uint items[]; } counts;

struct Box {
    vec3 least, most;
};

vec3 placeOf(uvec2 origin, uint i, uvec2 size, out float depth) {
    ivec2 pixel = min(ivec2(origin + uvec2(i % kPunctualTileSize, i / kPunctualTileSize)), ivec2(size) - 1);
    depth = texelFetch(depthMap, pixel, 0).x;
    return worldFromPixel(camera.camera.worldFromClip, size, pixel, depth);
}

bool reachesBox(vec4 light, Box box) {
    vec3 apart = max(max(box.least - light.xyz, light.xyz - box.most), vec3(0.0));
    return box.least.x <= box.most.x && dot(apart, apart) * light.w < 1.0;
}

void main() {
    uint tile = gl_WorkGroupID.x;
    uvec2 size = camera.camera.size, tiles = (size + kPunctualTileSize - 1) / kPunctualTileSize;
    uvec2 origin = uvec2(tile % tiles.x, tile / tiles.x) * kPunctualTileSize;
    const uint kPixels = kPunctualTileSize * kPunctualTileSize;
    float farthest = 1.0, nearest = 0.0;  // reversed depth
    for (uint i = laneIndex(); i < kPixels; i += kLanes) {
        float depth;
        placeOf(origin, i, size, depth);
        farthest = depth > 0.0 ? min(farthest, depth) : farthest;
        nearest = max(nearest, depth);
    }
    // Two boxes, so that an edge before a far wall does not take in all between them.
    float between = sqrt(laneMin(farthest) * laneMax(nearest));
    Box near = Box(vec3(3.0e38), vec3(-3.0e38)), far = near;
    for (uint i = laneIndex(); i < kPixels; i += kLanes) {
        float depth;
        vec3 x = placeOf(origin, i, size, depth);
        bool isNear = depth > between, isFar = depth > 0.0 && !isNear;
        near.least = isNear ? min(near.least, x) : near.least;
        near.most = isNear ? max(near.most, x) : near.most;
        far.least = isFar ? min(far.least, x) : far.least;
        far.most = isFar ? max(far.most, x) : far.most;
    }
    near = Box(laneMin(near.least), laneMax(near.most));
    far = Box(laneMin(far.least), laneMax(far.most));
    bool any = near.least.x <= near.most.x || far.least.x <= far.most.x;
    uint count = 0;
    for (uint base = 0; base < push.p.lightCount && count < kMaxPunctualLightsPerTile; base += kLanes) {
        uint light = base + laneIndex();
        vec4 place = fetchTexel(lights, int(min(light, push.p.lightCount - 1)) * 4);
        bool reaches = !kByRange || reachesBox(place, near) || reachesBox(place, far);
        bool mine = any && light < push.p.lightCount && reaches;
        LaneVote vote = laneVote(mine);
        uint at = count + vote.before;
        if (mine && at < kMaxPunctualLightsPerTile) lists.items[tile * kMaxPunctualLightsPerTile + at] = light;
        count += vote.count;
    }
    if (laneIndex() == 0) counts.items[tile] = min(count, kMaxPunctualLightsPerTile);
}
