// Where a place on a surface was seen in the frame before. Before: `previousSurface` (normal; m along the axis, 0: sky) and
// `cameras`.
#ifndef AG_BEFORE_GLSL
#define AG_BEFORE_GLSL

#include "common/pixel_rays.h"

struct Before {
    ivec2 taps[4];
    vec4 weights;  // their sum is 1, or 0: it was not seen
};

// `place`: relative to the world's origin, m.
Before seenBefore(ivec2 size, vec3 normal, vec3 place, float depth) {
    Before b;
    b.weights = vec4(0.0);
    ReprojectionCameras c = cameras.c;
    vec4 clip = c.previousClipFromWorld * vec4(place, 1.0);
    vec2 at = (clip.xy / max(clip.w, 1e-6) * 0.5 + 0.5) * vec2(size) - 0.5, low = floor(at);
    float footprint = 2.0 * c.pixelSize * max(depth, 1e-3);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 tap = ivec2(low) + ivec2(i & 1, i >> 1), there = clamp(tap, ivec2(0), size - 1);
        vec4 s = texelFetch(previousSurface, there, 0);
        vec3 apart = placeOf(c.before, vec2(there), s.w) + c.before.eye - place;
        vec2 f = max(1.0 - abs(vec2(tap) - at), 0.0);
        float like = tap == there && s.w > 0.0 ? likeness(normal, apart, footprint, s.xyz) : 0.0;
        b.taps[i] = there;
        b.weights[i] = like > 0.25 ? f.x * f.y * like : 0.0;
    }
    float total = dot(b.weights, vec4(1.0));
    bool any = depth > 0.0 && clip.w > 0.0 && total > 0.01;
    b.weights *= any ? 1.0 / total : 0.0;
    return b;
}
#endif
