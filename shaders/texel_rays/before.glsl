// Where a place on a surface was seen in the frame before. Before: `previousSurface` (normal; m along the axis, 0: sky) and
// `cameras`.
#ifndef AG_BEFORE_GLSL
#define AG_BEFORE_GLSL

#include "common/pixel_rays.h"

struct Before {
    ivec2 taps[4];
    vec4 weights;  // their sum is 1, or 0: it was not seen
    vec2 inTaps;   // the place from the first of them to the last
    float footprint;  // m
};

float likenessBefore(ivec2 tap, ivec2 size, vec3 normal, vec3 place, float footprint) {
    ivec2 there = clamp(tap, ivec2(0), size - 1);
    vec4 s = texelFetch(previousSurface, there, 0);
    vec3 apart = placeOf(cameras.c.before, vec2(there), s.w) + cameras.c.before.eye - place;
    return tap == there && s.w > 0.0 ? likeness(normal, apart, footprint, s.xyz) : 0.0;
}

const float kLeastLike = 0.25;

// `place`: relative to the world's origin, m.
Before seenBefore(ivec2 size, vec3 normal, vec3 place, float depth) {
    Before b;
    b.weights = vec4(0.0);
    ReprojectionCameras c = cameras.c;
    vec4 clip = c.previousClipFromWorld * vec4(place, 1.0);
    vec2 at = (clip.xy / max(clip.w, 1e-6) * 0.5 + 0.5) * vec2(size) - 0.5, low = floor(at);
    b.footprint = 2.0 * c.pixelSize * max(depth, 1e-3);
    b.inTaps = at - low;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 tap = ivec2(low) + ivec2(i & 1, i >> 1);
        vec2 f = max(1.0 - abs(vec2(tap) - at), 0.0);
        float like = likenessBefore(tap, size, normal, place, b.footprint);
        b.taps[i] = clamp(tap, ivec2(0), size - 1);
        b.weights[i] = like > kLeastLike ? f.x * f.y * like : 0.0;
    }
    float total = dot(b.weights, vec4(1.0));
    bool any = depth > 0.0 && clip.w > 0.0 && total > 0.01;
    b.weights *= any ? 1.0 / total : 0.0;
    return b;
}

// Of four taps in a row, from one before the place on (Catmull & Rom 1974): blends of them do not blur more and more from
// frame to frame, as linear ones do.
vec4 catmullRom(float f) {
    return vec4(f * (f * (1.0 - 0.5 * f) - 0.5), f * f * (1.5 * f - 2.5) + 1.0, f * (f * (2.0 - 1.5 * f) + 0.5), f * f * (0.5 * f - 0.5));
}

// Whether all of the 4 x 4 taps about the place are on its surface.
bool seenWhole(Before b, ivec2 size, vec3 normal, vec3 place) {
    if (dot(b.weights, vec4(1.0)) == 0.0) return false;
    bool whole = true;
    for (int i = 0; i < 16; ++i)
        whole = whole && likenessBefore(b.taps[0] + ivec2(i & 3, i >> 2) - 1, size, normal, place, b.footprint) > kLeastLike;
    return whole;
}
#endif
