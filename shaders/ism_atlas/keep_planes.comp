#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Traced maps that are kept as they were; the others start empty, as those of lights that are out stay.
#include "common/texels.glsl"
#include "ism_atlas/ism_atlas_io.h"

layout(local_size_x = 256) in;
layout(push_constant, scalar) uniform Push { IsmSplatPush p; } push;

layout(set = 0, binding = 0) VEC4_TEXELS(previous);
layout(set = 0, binding = 1, scalar) readonly buffer States { IsmMapState items[]; } states;
layout(set = 0, binding = 2, scalar) writeonly buffer Kept { vec4 items[]; } kept;

void main() {
    uint map = gl_WorkGroupID.y, texel = map * push.p.tileSize * push.p.tileSize + gl_GlobalInvocationID.x;
    vec4 old = fetchTexel(previous, int(texel));
    kept.items[texel] = states.items[map].kept != 0 ? old : vec4(0.0);
}
