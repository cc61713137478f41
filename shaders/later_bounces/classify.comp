#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// For each run of points, which lights are near and which far.
#include "common/lanes.glsl"
#include "common/texels.glsl"
#include "later_bounces/later_bounces_io.h"

layout(push_constant, scalar) uniform Push { GatherPush p; } push;

layout(set = 0, binding = 0) VEC4_TEXELS(texels);
layout(set = 0, binding = 1) VEC4_TEXELS(vals);
layout(set = 0, binding = 2) VEC4_TEXELS(shapes);
layout(set = 0, binding = 3, scalar) writeonly buffer Lists { uint items[]; } lists;
layout(set = 0, binding = 4, scalar) writeonly buffer Counts { uvec2 items[]; } counts;
#include "val_shading/sort_lights.glsl"

void main() {
    uint run_ = gl_WorkGroupID.x;
    Box box = kEmptyBox;
    for (uint i = laneIndex(); i < kRunPoints; i += kLanes) {
        int at = int(min(run_ * kRunPoints + i, push.p.count - 1)) * 3;
        if (fetchTexel(texels, at).w > 0.0) extend(box, fetchTexel(texels, at).xyz);
    }
    uvec2 count = sortLights(run_, boxOfLanes(box), 0, push.p.valCount, push.p.nearReach);
    if (laneIndex() == 0) counts.items[run_] = count;
}
