#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_arithmetic : require
// For each tile of the screen, which lights are near and which far; those that are black or that face away from the box
// round its surfaces are neither. In ascending order, by one subgroup a tile.
#include "common/lane_loop.glsl"
#include "gbuffer/gbuffer.glsl"
#include "val_fit/val_fit_io.h"
#include "val_shading/screen_tiles.glsl"

layout(local_size_x_id = 100) in;
layout(push_constant, scalar) uniform Push { ValShadingPush p; } push;

layout(set = 0, binding = 0) uniform sampler2D depthMap;
layout(set = 0, binding = 1, scalar) uniform Camera { CameraConstants camera; } camera;
layout(set = 0, binding = 2) uniform samplerBuffer vals;
layout(set = 0, binding = 3) uniform samplerBuffer shapes;
layout(set = 0, binding = 4, scalar) writeonly buffer Lists { uint items[]; } lists;
layout(set = 0, binding = 5, scalar) writeonly buffer Counts { uvec2 items[]; } counts;
layout(set = 0, binding = 6, scalar) writeonly buffer LackingCounts { uint items[]; } lackingCounts;

const float kDeepest = 3.0;  // thicknesses behind a light's plane: below 99.6 % of its texels

struct Box {
    vec3 least, most;
};

Box boxOfTile(uint tile) {
    Box box = Box(vec3(3.0e38), vec3(-3.0e38));
    uvec2 origin = uvec2(tile % push.p.tiles.x, tile / push.p.tiles.x) * push.p.tileSize;
    uvec2 size = camera.camera.size;
    mat4 worldFromClip = camera.camera.worldFromClip;
    uint side = push.p.tileSize, pixels = side * side;
    for (uint i = gl_SubgroupInvocationID; i < pixels; i += kSubgroupSize) {
        ivec2 pixel = ivec2(origin + uvec2(i % side, i / side));
        pixel = min(pixel, ivec2(size) - 1);
        float depth = texelFetch(depthMap, pixel, 0).x;
        vec3 x = worldFromPixel(worldFromClip, size, pixel, depth);
        if (depth > 0.0) {
            box.least = min(box.least, x);
            box.most = max(box.most, x);
        }
    }
    return Box(subgroupMin(box.least), subgroupMax(box.most));
}

void append(uint tile, uint list, bool mine, uint light, inout uint count) {
    uvec4 ballot = subgroupBallot(mine);
    if (mine) lists.items[listStart(tile, list, push.p.valCount) + count + subgroupBallotExclusiveBitCount(ballot)] = light;
    count += subgroupBallotBitCount(ballot);
}

void main() {
    uint tile = gl_WorkGroupID.x;
    Box box = boxOfTile(tile);
    vec3 middle = 0.5 * (box.least + box.most), half_ = 0.5 * (box.most - box.least);
    bool any = box.least.x <= box.most.x;
    uvec2 count = uvec2(0);
    for (uint base = 0; base < push.p.valCount; base += kSubgroupSize) {
        uint light = base + gl_SubgroupInvocationID;
        int at = int(min(light, push.p.valCount - 1));
        vec3 place = texelFetch(vals, at * 3).xyz;
        vec4 normal = texelFetch(vals, at * 3 + 1);  // and thickness
        bool lit = texelFetch(vals, at * 3 + 2).rgb != vec3(0.0) && any && light < push.p.valCount;
        vec3 d = middle - place;
        bool reaches = lit && dot(d, normal.xyz) + dot(half_, abs(normal.xyz)) > -kDeepest * normal.w;
        vec3 apart = max(abs(d) - half_, vec3(0.0));
        vec3 halfU = texelFetch(shapes, at * int(kValShapeVec4s)).xyz;
        float reach = push.p.nearReach * length(halfU);
        bool near = reaches && dot(apart, apart) < reach * reach;
        append(tile, kNearList, near, light, count.x);
        append(tile, kFarList, reaches && !near, light, count.y);
    }
    if (gl_SubgroupInvocationID == 0) {
        counts.items[tile] = count;
        lackingCounts.items[tile] = 0;
    }
}
