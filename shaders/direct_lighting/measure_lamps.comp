#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_arithmetic : require
// How much each lamp matters to what is seen: its light at points of the view, without shadows. One subgroup a lamp.
#include "common/lane_loop.glsl"
#include "direct_lighting/direct_lighting_io.h"
#include "gbuffer/view_points_io.h"

layout(local_size_x_id = 100) in;
layout(push_constant, scalar) uniform Push { MeasurePush p; } push;

layout(set = 0, binding = 0) uniform samplerBuffer lamps;
#include "direct_lighting/lamp.glsl"
layout(set = 0, binding = 1) uniform samplerBuffer viewPoints;
layout(set = 0, binding = 2, scalar) writeonly buffer Relevance { LampRelevance items[]; } relevance;

void main() {
    uint index = gl_WorkGroupID.x;
    bool isLamp = index < push.p.lampCount;
    Lamp lamp = lampAt(isLamp ? index : 0);
    float sum = 0.0;
    uint count = isLamp ? push.p.pointCount : 0;
    for (uint i = gl_SubgroupInvocationID; i < count; i += kSubgroupSize) {
        vec4 place = texelFetch(viewPoints, int(2 * i)), normal = texelFetch(viewPoints, int(2 * i + 1));
        float distance2;
        vec3 e = irradianceFrom(lamp, place.xyz, normal.xyz, distance2);
        sum += place.w > 0.0 ? e.r + e.g + e.b : 0.0;
    }
    sum = subgroupAdd(sum);
    if (gl_SubgroupInvocationID == 0)
        relevance.items[index] = LampRelevance(lamp.id, isLamp ? max(sum, 1e-30) : 0.0);
}
