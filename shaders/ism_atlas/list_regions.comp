#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Before movable surfaces are splatted: the regions where the static layer is to show again. After it: those to finish anew.
// Both are where movable surfaces showed when the map was finished last (after it also where they show now), and all where
// the static layer is another.
#include "ism_atlas/regions.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { IsmSplatPush p; uint mapCount; } push;
layout(constant_id = 0) const bool kBefore = false;

layout(set = 0, binding = 0, scalar) readonly buffer Places { IsmPlace items[]; } places;
layout(set = 0, binding = 1, scalar) readonly buffer PreviousFinishes { IsmFinish items[]; } previousFinishes;
layout(set = 0, binding = 2, scalar) buffer Finishes { IsmFinish items[]; } finishes;
layout(set = 0, binding = 3, scalar) writeonly buffer Listed { uint items[]; } listed;
layout(set = 0, binding = 4, scalar) buffer Groups { uvec3 count; } groups;

void main() {
    uint map = gl_GlobalInvocationID.x;
    if (map >= push.mapCount) return;
    IsmFinish old = previousFinishes.items[map];
    if (kBefore) finishes.items[map] = IsmFinish(places.items[map].made, uint[](0u, 0u));
    IsmFinish now = finishes.items[map];
    uvec2 shows = uvec2(old.touched[0] | now.touched[0], old.touched[1] | now.touched[1]);
    uvec2 mask = old.made == now.made ? shows : allRegions(push.p.tileSize);
    AG_LIST_REGIONS(map, mask)
}
