#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The regions whose keys are to be the still layer's again before movable surfaces are splatted: where they showed when
// the map was finished last, and all where that layer is another.
#include "ism_atlas/regions.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { IsmSplatPush p; uint mapCount; } push;

layout(set = 0, binding = 0, scalar) readonly buffer Places { IsmPlace items[]; } places;
layout(set = 0, binding = 1, scalar) readonly buffer PreviousFinishes { IsmFinish items[]; } previousFinishes;
layout(set = 0, binding = 2, scalar) writeonly buffer Finishes { IsmFinish items[]; } finishes;
layout(set = 0, binding = 3, scalar) writeonly buffer Listed { uint items[]; } listed;
layout(set = 0, binding = 4, scalar) buffer Groups { uvec3 count; } groups;

void main() {
    uint map = gl_GlobalInvocationID.x;
    if (map >= push.mapCount) return;
    IsmFinish old = previousFinishes.items[map];
    uint made = places.items[map].made;
    finishes.items[map] = IsmFinish(made, uint[](0u, 0u));
    uvec2 mask = old.made == made ? uvec2(old.touched[0], old.touched[1]) : allRegions(push.p.tileSize);
    AG_LIST_REGIONS(map, mask)
}
