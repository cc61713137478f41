#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The points of movable surfaces each map is made of.
#include "common/lanes.glsl"
#include "common/texels.glsl"
#include "ism_atlas/ism_atlas_io.h"

layout(push_constant, scalar) uniform Push { IsmSplatPush p; } push;

layout(set = 0, binding = 0) VEC4_TEXELS(segments);
layout(set = 0, binding = 1) VEC4_TEXELS(vals);
layout(set = 0, binding = 2, scalar) buffer Chosen { uint items[]; } chosen;
layout(set = 0, binding = 3, scalar) writeonly buffer States { IsmMapState items[]; } states;
#include "ism_atlas/choose_points.glsl"

void main() {
    uint map = gl_WorkGroupID.x;
    uint count = choosePoints(map, AG_ISM_LIGHT(vals, map));
    if (laneIndex() == 0) states.items[map] = IsmMapState(count, 0);
}
