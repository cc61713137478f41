#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// How much each punctual light matters to what is seen: its light at points of the view, without shadows. One group of
// lanes a light.
#include "common/lanes.glsl"
#include "common/texels.glsl"
#include "direct_lighting/direct_lighting_io.h"
#include "gbuffer/view_points_io.h"

layout(push_constant, scalar) uniform Push { MeasurePush p; } push;

layout(set = 0, binding = 0) VEC4_TEXELS(lights);
#include "direct_lighting/punctual_light.glsl"
layout(set = 0, binding = 1) VEC4_TEXELS(viewPoints);
layout(set = 0, binding = 2, scalar) writeonly buffer Relevance { PunctualRelevance items[]; } relevance;

void main() {
    uint index = gl_WorkGroupID.x;
    bool isLight = index < push.p.lightCount;
    PunctualLight light = punctualLightAt(isLight ? index : 0);
    float sum = 0.0;
    uint count = isLight ? push.p.pointCount : 0;
    for (uint i = laneIndex(); i < count; i += kLanes) {
        vec4 place = fetchTexel(viewPoints, int(2 * i)), normal = fetchTexel(viewPoints, int(2 * i + 1));
        float distance2;
        vec3 e = irradianceFrom(light, place.xyz, normal.xyz, distance2);
        sum += place.w > 0.0 ? e.r + e.g + e.b : 0.0;
    }
    sum = laneAdd(sum);
    if (laneIndex() == 0)
        relevance.items[index] = PunctualRelevance(light.id, isLight ? max(sum, 1e-30) : 0.0);
}
