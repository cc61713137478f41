#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_arithmetic : require
// For each tile of the screen the lamps whose range reaches into the box round its surfaces, in ascending order, by one
// subgroup a tile.
#include "common/lane_loop.glsl"
#include "direct_lighting/direct_lighting_io.h"
#include "gbuffer/gbuffer.glsl"

layout(local_size_x_id = 100) in;
layout(push_constant, scalar) uniform Push { LampPush p; } push;

layout(constant_id = 0) const bool kByRange = true;  // false: all lamps everywhere
layout(set = 0, binding = 0) uniform sampler2D depthMap;
layout(set = 0, binding = 1, scalar) readonly buffer Camera { CameraConstants camera; } camera;
layout(set = 0, binding = 2) uniform samplerBuffer lamps;
layout(set = 0, binding = 3, scalar) writeonly buffer Lists { uint items[]; } lists;
layout(set = 0, binding = 4, scalar) writeonly buffer Counts { uint items[]; } counts;

void main() {
    uint tile = gl_WorkGroupID.x;
    uvec2 size = camera.camera.size, tiles = (size + kLampTileSize - 1) / kLampTileSize;
    uvec2 origin = uvec2(tile % tiles.x, tile / tiles.x) * kLampTileSize;
    vec3 least = vec3(3.0e38), most = vec3(-3.0e38);
    for (uint i = gl_SubgroupInvocationID; i < kLampTileSize * kLampTileSize; i += kSubgroupSize) {
        ivec2 pixel = min(ivec2(origin + uvec2(i % kLampTileSize, i / kLampTileSize)), ivec2(size) - 1);
        float depth = texelFetch(depthMap, pixel, 0).x;
        vec3 x = worldFromPixel(camera.camera.worldFromClip, size, pixel, depth);
        if (depth > 0.0) {
            least = min(least, x);
            most = max(most, x);
        }
    }
    least = subgroupMin(least);
    most = subgroupMax(most);
    bool any = least.x <= most.x;
    vec3 middle = 0.5 * (least + most), half_ = 0.5 * (most - least);
    uint count = 0;
    for (uint base = 0; base < push.p.lampCount && count < kMaxLampsPerTile; base += kSubgroupSize) {
        uint lamp = base + gl_SubgroupInvocationID;
        vec4 place = texelFetch(lamps, int(min(lamp, push.p.lampCount - 1)) * 4);
        vec3 apart = max(abs(middle - place.xyz) - half_, vec3(0.0));
        bool reaches = !kByRange || place.w <= 0.0 || dot(apart, apart) < place.w * place.w;
        bool mine = any && lamp < push.p.lampCount && reaches;
        uvec4 ballot = subgroupBallot(mine);
        uint at = count + subgroupBallotExclusiveBitCount(ballot);
        if (mine && at < kMaxLampsPerTile) lists.items[tile * kMaxLampsPerTile + at] = lamp;
        count += subgroupBallotBitCount(ballot);
    }
    if (gl_SubgroupInvocationID == 0) counts.items[tile] = min(count, kMaxLampsPerTile);
}
