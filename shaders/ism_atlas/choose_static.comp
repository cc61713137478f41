#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The static points each map is made of. A map whose light and whose static points stand where they stood is kept; the
// others are listed to be splatted.
#include "common/lanes.glsl"
#include "common/texels.glsl"
#include "ism_atlas/ism_atlas_io.h"

layout(push_constant, scalar) uniform Push { IsmSplatPush p; } push;

layout(set = 0, binding = 0) VEC4_TEXELS(segments);
layout(set = 0, binding = 1) VEC4_TEXELS(vals);
layout(set = 0, binding = 2, scalar) writeonly buffer Chosen { uint items[]; } chosen;
layout(set = 0, binding = 3, scalar) writeonly buffer Places { IsmPlace items[]; } places;
layout(set = 0, binding = 4, scalar) writeonly buffer States { IsmMapState items[]; } states;
layout(set = 0, binding = 5, scalar) readonly buffer PreviousPlaces { IsmPlace items[]; } previousPlaces;
layout(set = 0, binding = 6) UINT_TEXELS(previousChosen);
layout(set = 0, binding = 7, scalar) writeonly buffer Anew { uint items[]; } anew;
layout(set = 0, binding = 8, scalar) buffer AnewGroups { uvec3 count; } anewGroups;
#include "ism_atlas/choose_points.glsl"

void main() {
    uint map = gl_WorkGroupID.x;
    IsmPlace old = previousPlaces.items[map];
    IsmPlace place = IsmPlace(fetchTexel(vals, int(map) * 3).xyz, push.p.contents, fetchTexel(vals, int(map) * 3 + 1).xyz,
                              fetchTexel(vals, int(map) * 3 + 2).w, old.made);
    IsmLight light = AG_ISM_LIGHT(vals, map);
    bool kept = light.lit && push.p.contents != 0 && old == place;
    IsmMapState state = IsmMapState(0, kept ? 1 : 0);
    if (kept) {
        uint first = firstEntryOf(map);
        for (uint i = laneIndex(); i < push.p.entryCount; i += kLanes)
            chosen.items[first + i] = fetchTexel(previousChosen, int(first + i)).x;
    } else {
        state.pointCount = choosePoints(map, light);
        ++place.made;
    }
    if (!light.lit) place.contents = 0;
    if (laneIndex() == 0) {
        places.items[map] = place;
        states.items[map] = state;
        if (state.pointCount > 0) anew.items[atomicAdd(anewGroups.count.y, 1)] = map;
    }
}
