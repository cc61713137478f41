// Which points of a layer each map is made of: of a segment of the curve through all surfaces so many as its distance
// from the light asks for (as the solid angle of its area: area / d²), none from behind the light's plane. What the light
// sees is then cut as finely near by as far off. One group of lanes a map; systematic sampling along the curve, from another
// place in each map. Needs buffers `segments`, `chosen` and the push constants.
#ifndef AG_CHOOSE_POINTS_GLSL
#define AG_CHOOSE_POINTS_GLSL

#include "common/lanes.glsl"
#include "ism_atlas/ism_light.glsl"
#include "surface_points/surface_points_io.h"

layout(constant_id = 0) const bool kByDistance = true;
const float kMost = float(kSegmentPoints);

uint firstEntryOf(uint map) { return map * push.p.entryCount; }

// Of a segment, relative to other segments.
float weightOf(IsmLight light, uint segment) {
    vec4 ball = fetchTexel(segments, int(min(segment, push.p.endSegment - 1)));
    vec2 radiusAndArea = unpackHalf2x16(floatBitsToUint(ball.w));
    float radius = radiusAndArea.x, area = radiusAndArea.y;
    vec3 d = ball.xyz - light.place;
    bool asked = segment < push.p.endSegment && light.lit && area > 0.0 && (!kByDistance || dot(d, light.normal) > -radius);
    return asked ? kByDistance ? area / max(dot(d, d), radius * radius) : area : 0.0;
}

// The factor from weight to points that makes them entryCount, no segment having more than all of its own.
float pointsPerWeight(IsmLight light) {
    const int kRounds = 2;
    float factor = 0.0;
    for (int round_ = 0; round_ < kRounds; ++round_) {
        float full = 0.0, rest = 0.0;
        for (uint base = push.p.firstSegment; base < push.p.endSegment; base += kLanes) {
            float w = weightOf(light, base + laneIndex());
            full += w * factor >= kMost ? kMost : 0.0;
            rest += w * factor >= kMost ? 0.0 : w;
        }
        float left = max(float(push.p.entryCount) - laneAdd(full), 0.0);
        factor = max(factor, left / max(laneAdd(rest), 1e-20));
    }
    return factor;
}

// Writes the map's points; returns how many. A lane goes on at the very entry the one before it stopped at: a running
// sum less what was added last may round to another, and an entry nobody writes is one of an older frame.
uint choosePoints(uint map, IsmLight light) {
    uint scramble = hashUint(map), written = 0;
    float factor = pointsPerWeight(light), before = hashToUnit(map + 1);
    for (uint base = push.p.firstSegment; base < push.p.endSegment; base += kLanes) {
        uint segment = base + laneIndex();
        float asked = min(weightOf(light, segment) * factor, kMost);
        float end = before + laneInclusiveAdd(asked);
        uint wanted = min(uint(end), push.p.entryCount);
        uint first = max(laneExclusiveMax(wanted), written), last = max(laneInclusiveMax(wanted), written);
        // Fewer points stand for the same surface: their disks are larger.
        float growth = push.p.diskRadius * sqrt(kMost / max(asked, 1e-6));
        for (uint i = first; i < last; ++i) {
            uint rank = bitfieldReverse(i - first) >> 26 ^ scramble & (kSegmentPoints - 1);
            chosen.items[firstEntryOf(map) + i] =
                packIsmPoint(min(segment * kSegmentPoints + rank, push.p.pointCount - 1), growth);
        }
        before = laneMax(end);
        written = laneMax(last);
    }
    return written;
}
#endif
