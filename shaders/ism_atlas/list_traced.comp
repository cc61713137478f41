#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Maps whose light stands elsewhere than they were traced from, or whose static surfaces do; the others are kept.
#include "common/texels.glsl"
#include "ism_atlas/ism_atlas_io.h"
#include "ism_atlas/ism_light.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { IsmSplatPush p; uint mapCount; } push;

layout(set = 0, binding = 0) VEC4_TEXELS(vals);
layout(set = 0, binding = 1, scalar) readonly buffer PreviousPlaces { IsmPlace items[]; } previousPlaces;
layout(set = 0, binding = 2, scalar) writeonly buffer Places { IsmPlace items[]; } places;
layout(set = 0, binding = 3, scalar) writeonly buffer States { IsmMapState items[]; } states;
layout(set = 0, binding = 4, scalar) writeonly buffer Anew { uint items[]; } anew;
layout(set = 0, binding = 5, scalar) buffer AnewGroups { uvec3 count; } anewGroups;

void main() {
    uint map = gl_GlobalInvocationID.x;
    if (map >= push.mapCount) return;
    IsmPlace old = previousPlaces.items[map];
    IsmPlace place = IsmPlace(fetchTexel(vals, int(map) * 3).xyz, push.p.contents, fetchTexel(vals, int(map) * 3 + 1).xyz,
                              fetchTexel(vals, int(map) * 3 + 2).w, old.made);
    bool lit = AG_ISM_LIGHT(vals, map).lit, kept = lit && push.p.contents != 0 && old == place;
    if (!kept) ++place.made;
    if (!lit) place.contents = 0;
    places.items[map] = place;
    states.items[map] = IsmMapState(lit && !kept ? 1 : 0, kept ? 1 : 0);
    if (lit && !kept) anew.items[atomicAdd(anewGroups.count.y, 1)] = map;
}
