#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Automatic exposure. A histogram of log luminance over the lit pixels gives their mean without the darkest and the
// brightest; exposure moves toward what makes that mean middle gray. One group of lanes. Sums are of integers, so the
// order of lanes does not matter.
#include "common/lanes.glsl"
#include "common/pixel_rays.h"
#include "exposure/exposure_io.h"

layout(push_constant, scalar) uniform Push { MeterPush push; };

layout(set = 0, binding = 0) uniform sampler2D radianceMap;
layout(set = 0, binding = 1, scalar) readonly buffer Before { Exposure exposure; } before;
layout(set = 0, binding = 2, scalar) writeonly buffer After { Exposure exposure; } after;

const float kParts = 256.0;       // of a bin: a pixel adds its place within the bin in these
const float kSettled = 1 / 64.0;  // stops; once so near, exposure is at its target

shared uint counts[kExposureBins], parts[kExposureBins];

void countPixels() {
    ivec2 size = textureSize(radianceMap, 0), grid = (size + int(push.stride) - 1) / int(push.stride);
    for (uint i = laneIndex(); i < grid.x * grid.y; i += kLanes) {
        ivec2 pixel = ivec2(i % grid.x, i / grid.x) * int(push.stride) + int(push.stride) / 2;
        float l = luminance(texelFetch(radianceMap, min(pixel, size - 1), 0).rgb);
        if (!(l > exp2(kLeastLuminanceStops))) continue;
        float place = min((log2(l) - kLeastLuminanceStops) * kExposureBinsAStop, kExposureBins - 0.01);
        atomicAdd(counts[uint(place)], 1);
        atomicAdd(parts[uint(place)], uint(fract(place) * kParts));
    }
}

// Of log2 luminance. False where the picture is black.
bool meteredMean(out float mean) {
    uint total = 0;
    for (uint b = 0; b < kExposureBins; ++b) total += counts[b];
    float begin = total * kDarkestShare, end = total * (1.0 - kBrightestShare), below = 0, sum = 0, weight = 0;
    for (uint b = 0; b < kExposureBins; ++b) {
        float n = counts[b], inside = max(min(below + n, end) - max(below, begin), 0.0);
        if (inside > 0) sum += inside * (b + (parts[b] / n + 0.5) / kParts);
        weight += inside;
        below += n;
    }
    mean = kLeastLuminanceStops + sum / max(weight, 1e-6) / kExposureBinsAStop;
    return total > 0;
}

void main() {
    for (uint b = laneIndex(); b < kExposureBins; b += kLanes) counts[b] = parts[b] = 0;
    laneBarrier();
    countPixels();
    laneBarrier();
    if (laneIndex() > 0) return;
    float mean, wanted = 0;
    if (meteredMean(mean)) wanted = log2(kMiddleGray) - mean - push.unitStops;
    float target = clamp(wanted, push.least, push.most) + push.compensation;
    float stops = push.valid != 0 ? mix(before.exposure.stops, target, push.share) : target;
    if (abs(stops - target) < kSettled) stops = target;
    after.exposure = Exposure(stops);
}
