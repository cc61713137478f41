#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_arithmetic : require
// Which points each map is made of: of a segment of the curve through all surfaces so many as its distance from the
// light asks for (as the solid angle of its area: 1 / d²), none from behind the light's plane. What the light sees is
// then cut as finely near by as far off. One subgroup a map; systematic sampling along the curve, from another place
// in each map. A map whose light and whose points stand where they stood is kept.
#include "common/lane_loop.glsl"
#include "ism_atlas/ism_atlas_io.h"
#include "ism_atlas/ism_light.glsl"
#include "surface_points/surface_points_io.h"

layout(local_size_x_id = 100) in;
layout(constant_id = 0) const bool kByDistance = true;
layout(push_constant, scalar) uniform Push { IsmSplatPush p; } push;

layout(set = 0, binding = 0) uniform samplerBuffer segments;
layout(set = 0, binding = 1) uniform samplerBuffer vals;
layout(set = 0, binding = 2, scalar) writeonly buffer Chosen { uint items[]; } chosen;
layout(set = 0, binding = 3, scalar) writeonly buffer Places { IsmPlace items[]; } places;
layout(set = 0, binding = 4, scalar) writeonly buffer States { IsmMapState items[]; } states;
layout(set = 0, binding = 5, scalar) readonly buffer PreviousPlaces { IsmPlace items[]; } previousPlaces;
layout(set = 0, binding = 6) uniform usamplerBuffer previousChosen;

const float kMost = float(kSegmentPoints);

// Of a segment, relative to other segments.
float weightOf(IsmLight light, uint segment) {
    vec4 ball = texelFetch(segments, int(min(segment, push.p.segmentCount - 1)));
    vec3 d = ball.xyz - light.place;
    bool asked = segment < push.p.segmentCount && light.lit && (!kByDistance || dot(d, light.normal) > -ball.w);
    return asked ? kByDistance ? 1.0 / max(dot(d, d), ball.w * ball.w) : 1.0 : 0.0;
}

// The factor from weight to points that makes them pointsPerMap, no segment having more than all of its own.
float pointsPerWeight(IsmLight light) {
    const int kRounds = 4;
    float factor = 0.0;
    for (int round_ = 0; round_ < kRounds; ++round_) {
        float full = 0.0, rest = 0.0;
        for (uint base = 0; base < push.p.segmentCount; base += kSubgroupSize) {
            float w = weightOf(light, base + gl_SubgroupInvocationID);
            full += w * factor >= kMost ? kMost : 0.0;
            rest += w * factor >= kMost ? 0.0 : w;
        }
        float left = max(float(push.p.pointsPerMap) - subgroupAdd(full), 0.0);
        factor = max(factor, left / max(subgroupAdd(rest), 1e-20));
    }
    return factor;
}

// Writes the map's points; returns how many.
uint choosePoints(uint map, IsmLight light) {
    uint scramble = hashUint(map);
    float factor = pointsPerWeight(light), before = hashToUnit(map + 1);
    for (uint base = 0; base < push.p.segmentCount; base += kSubgroupSize) {
        uint segment = base + gl_SubgroupInvocationID;
        float asked = min(weightOf(light, segment) * factor, kMost);
        float end = before + subgroupInclusiveAdd(asked);
        uint first = min(uint(end - asked), push.p.pointsPerMap), last = min(uint(end), push.p.pointsPerMap);
        // Fewer points stand for the same surface: their disks are larger.
        float radius = push.p.pointRadius * sqrt(kMost / max(asked, 1e-6));
        for (uint i = first; i < last; ++i) {
            uint rank = bitfieldReverse(i - first) >> 26 ^ scramble & (kSegmentPoints - 1);
            chosen.items[map * push.p.pointsPerMap + i] =
                packIsmPoint(min(segment * kSegmentPoints + rank, push.p.pointCount - 1), radius);
        }
        before += subgroupAdd(asked);
    }
    return min(uint(before), push.p.pointsPerMap);
}

void main() {
    uint map = gl_WorkGroupID.x;
    IsmPlace old = previousPlaces.items[map];
    IsmPlace place = IsmPlace(texelFetch(vals, int(map) * 3).xyz, push.p.contents, texelFetch(vals, int(map) * 3 + 1).xyz,
                              texelFetch(vals, int(map) * 3 + 2).w);
    IsmLight light = AG_ISM_LIGHT(vals, map);
    bool kept = light.lit && push.p.contents != 0 && old == place;
    IsmMapState state = IsmMapState(0, kept ? 1 : 0);
    if (kept) {
        for (uint i = gl_SubgroupInvocationID; i < push.p.pointsPerMap; i += kSubgroupSize)
            chosen.items[map * push.p.pointsPerMap + i] = texelFetch(previousChosen, int(map * push.p.pointsPerMap + i)).x;
    } else {
        state.pointCount = choosePoints(map, light);
    }
    if (!light.lit) place.contents = 0;
    if (gl_SubgroupInvocationID == 0) {
        places.items[map] = place;
        states.items[map] = state;
    }
}
