#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The static layer's keys, for the movable surfaces to be splatted over; of listed regions, where the others are.
#include "common/texels.glsl"
#include "ism_atlas/regions.glsl"

layout(local_size_x = 256) in;  // a region
layout(push_constant, scalar) uniform Push { IsmSplatPush p; } push;

layout(constant_id = 0) const bool kTraced = false;  // then the static layer has planes, and keys start empty

layout(set = 0, binding = 0, scalar) readonly buffer Listed { uint items[]; } listed;
layout(set = 0, binding = 1) UINT_TEXELS(staticKeys);
layout(set = 0, binding = 2, scalar) writeonly buffer Keys { uint items[]; } keys;

void main() {
    IsmRegion region = regionOf(listed.items[gl_WorkGroupID.x]);
    uint texel = regionTexel(region.map, region.first, push.p.tileSize) + gl_LocalInvocationID.x;
    keys.items[texel] = kTraced ? kIsmNoPoint : fetchTexel(staticKeys, int(texel)).x;
}
