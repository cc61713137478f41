#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The nearest points' planes and distances, for the lookup.
#include "ism_atlas/ism_atlas_io.h"
#include "ism_atlas/ism_light.glsl"

layout(local_size_x = 256) in;
layout(push_constant, scalar) uniform Push { IsmSplatPush p; } push;

layout(set = 0, binding = 0) uniform samplerBuffer points;
layout(set = 0, binding = 1) uniform samplerBuffer vals;
layout(set = 0, binding = 2) uniform usamplerBuffer keys;
layout(set = 0, binding = 3, scalar) writeonly buffer Planes { vec4 items[]; } planes;

void main() {
    uint map = gl_WorkGroupID.y, texels = push.p.tileSize * push.p.tileSize;
    uint texel = map * texels + gl_GlobalInvocationID.x;  // tiles are whole workgroups
    uint key = texelFetch(keys, int(texel)).x;
    int point = int(min(key & ((1u << kIsmPointBits) - 1u), push.p.pointCount - 1u));
    IsmLight light = AG_ISM_LIGHT(vals, map);
    vec3 p = toLight(light, texelFetch(points, point * 4).xyz - light.place);
    vec3 m = planeThrough(p, toLight(light, texelFetch(points, point * 4 + 1).xyz));
    planes.items[texel] = key == kIsmNoPoint ? vec4(0.0) : vec4(m, length(p));
}
