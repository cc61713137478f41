// Which lights are near to a tile of receivers and which far; those that are black or whose plane faces away from the box
// round the receivers are the rest (some of their texels may face it). Near and far ones in ascending order, by one group of lanes a tile. Needs buffers `vals`, `shapes`, `lists`.
#ifndef AG_SORT_LIGHTS_GLSL
#define AG_SORT_LIGHTS_GLSL

#include "common/lanes.glsl"
#include "val_fit/val_fit_io.h"
#include "val_shading/light_lists.glsl"

const float kDeepest = 3.0;  // thicknesses behind a light's plane: below 99.6 % of its texels

struct Box {
    vec3 least, most;
};

const Box kEmptyBox = Box(vec3(3.0e38), vec3(-3.0e38));

void extend(inout Box box, vec3 x) {
    box.least = min(box.least, x);
    box.most = max(box.most, x);
}

Box boxOfLanes(Box mine) { return Box(laneMin(mine.least), laneMax(mine.most)); }

void appendLight(uint start, bool mine, uint light, inout uint count) {
    LaneVote vote = laneVote(mine);
    if (mine) lists.items[start + count + vote.before] = light;
    count += vote.count;
}

// Behind the near ones, from the end on.
void appendToRest(uint start, bool mine, uint light, uint valCount, inout uint count) {
    LaneVote vote = laneVote(mine);
    if (mine) lists.items[start + valCount - 1 - count - vote.before] = light;
    count += vote.count;
}

// How many from firstVal to valCount are near and far. nearReach: lights nearer than this many of their half lengths are near.
uvec2 sortLights(uint tile, Box box, uint firstVal, uint valCount, float nearReach) {
    vec3 middle = 0.5 * (box.least + box.most), half_ = 0.5 * (box.most - box.least);
    bool any = box.least.x <= box.most.x;
    uvec2 count = uvec2(0);
    uint rest = 0;
    for (uint base = firstVal; base < valCount; base += kLanes) {
        uint light = base + laneIndex();
        int at = int(min(light, valCount - 1));
        vec3 place = fetchTexel(vals, at * 3).xyz;
        vec4 normal = fetchTexel(vals, at * 3 + 1);  // and thickness
        bool lit = fetchTexel(vals, at * 3 + 2).rgb != vec3(0.0) && any && light < valCount;
        vec3 d = middle - place;
        bool reaches = lit && dot(d, normal.xyz) + dot(half_, abs(normal.xyz)) > -kDeepest * abs(normal.w);
        vec3 apart = max(abs(d) - half_, vec3(0.0));
        vec3 halfU = fetchTexel(shapes, at * int(kValShapeVec4s)).xyz;
        float reach = nearReach * length(halfU);
        bool near = reaches && dot(apart, apart) < reach * reach;
        appendLight(listStart(tile, kNearList, valCount), near, light, count.x);
        appendLight(listStart(tile, kFarList, valCount), reaches && !near, light, count.y);
        appendToRest(listStart(tile, kNearList, valCount), !reaches && light < valCount, light, valCount, rest);
    }
    return count;
}
#endif
