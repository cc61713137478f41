// Whether a block's rays find more or less than noise allows. By all of a workgroup of 64.
#ifndef AG_SURPRISE_GLSL
#define AG_SURPRISE_GLSL

shared vec3 surpriseSums[64];

// Of the block's rays against its means, in standard deviations of such a difference.
float surprise(float now, float mean, float variance) {
    surpriseSums[gl_LocalInvocationIndex] = vec3(now, mean, variance);
    for (uint half_ = 32; half_ > 0; half_ /= 2) {
        barrier();
        if (gl_LocalInvocationIndex < half_) surpriseSums[gl_LocalInvocationIndex] += surpriseSums[gl_LocalInvocationIndex + half_];
    }
    barrier();
    vec3 all = surpriseSums[0];
    return abs(all.x - all.y) / max(sqrt(all.z) + 0.02 * all.y, 1e-20);
}

// Of the frames that a mean stands for, the part that stays.
float keptOf(float surprise_) { return clamp(2.0 - surprise_ / 3.0, 0.0, 1.0); }
#endif
