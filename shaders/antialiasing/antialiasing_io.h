// Anti-aliasing: where pixels are sampled from frame to frame, and by how much each sample counts.
#ifndef AG_ANTIALIASING_IO_H
#define AG_ANTIALIASING_IO_H

#include "common/portable.h"

AG_BEGIN

const float kFilterRadius = 1.5f;      // pixels of the output
const float kLeastContrast = 0.04f;    // of neighbours' luma, display values: below it is no edge
const float kRelativeContrast = 0.1f;  // the same, of the brighter one

struct ResolvePush {
    vec2 jitter;    // rendered pixels, from a pixel's centre to where it was sampled
    float near;     // m
    float most;     // samples that what was known counts for at most; 0: nothing is known
    uint stands;    // nothing but the jitter changed since the frame before
    uint sameView;  // the camera stands where it stood
    uint rests;     // neither this frame nor the one before is jittered
};

// Blackman-Harris window (Harris 1978) of pixels off the centre: a sample's weight along one axis, 1 in all
// where there is a sample a pixel.
AG_FUNCTION float filterWeight(float x) {
    float c = cos(kPi * x / kFilterRadius), c2 = 2.0f * c * c - 1.0f, c3 = c * (2.0f * c2 - 1.0f);
    float sum = 0.35875f + 0.48829f * c + 0.14128f * c2 + 0.01168f * c3;
    return abs(x) < kFilterRadius ? sum / (0.35875f * 2.0f * kFilterRadius) : 0.0f;
}

AG_END
#endif
