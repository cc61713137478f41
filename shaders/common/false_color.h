// Colours that stand for numbers.
#ifndef AG_FALSE_COLOR_H
#define AG_FALSE_COLOR_H

#include "common/sampling.h"

AG_BEGIN

// Neighbouring indices get unlike hues.
AG_FUNCTION vec3 hueFromIndex(uint i) {
    float hue = fract(float(i % 1024u) * 0.61803399f);
    float value = 0.65f + 0.35f * hashToUnit(i);
    vec3 wheel =
        abs(fract(vec3(hue) + vec3(0.0f, 2.0f / 3.0f, 1.0f / 3.0f)) * 6.0f - vec3(3.0f)) - vec3(1.0f);
    return mix(vec3(1.0f), clamp(wheel, vec3(0.0f), vec3(1.0f)), 0.75f) * value;
}

// Dark blue over green to yellow, monotone in brightness; t in [0, 1].
AG_FUNCTION vec3 heat(float t) {
    vec3 low = mix(vec3(0.05f, 0.03f, 0.25f), vec3(0.10f, 0.55f, 0.55f), clamp(t * 2.0f, 0.0f, 1.0f));
    return mix(low, vec3(1.0f, 0.95f, 0.25f), clamp(t * 2.0f - 1.0f, 0.0f, 1.0f));
}

AG_END
#endif
