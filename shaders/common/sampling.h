// Low-discrepancy points and integer hashes.
#ifndef AG_SAMPLING_H
#define AG_SAMPLING_H

#include "common/portable.h"

AG_BEGIN

// The upper 24 bits as a number in [0, 1).
AG_FUNCTION float unitOf(uint bits) {
    return float(bits >> 8u) / 16777216.0f;
}

// Van der Corput in base 2: the bits mirrored at the point.
AG_FUNCTION float radicalInverse2(uint bits) {
    bits = (bits << 16u) | (bits >> 16u);
    bits = ((bits & 0x55555555u) << 1u) | ((bits & 0xaaaaaaaau) >> 1u);
    bits = ((bits & 0x33333333u) << 2u) | ((bits & 0xccccccccu) >> 2u);
    bits = ((bits & 0x0f0f0f0fu) << 4u) | ((bits & 0xf0f0f0f0u) >> 4u);
    bits = ((bits & 0x00ff00ffu) << 8u) | ((bits & 0xff00ff00u) >> 8u);
    return unitOf(bits);
}

AG_FUNCTION float radicalInverse3(uint index) {
    float result = 0.0f, digit = 1.0f / 3.0f;
    for (int i = 0; i < 20 && index > 0u; ++i) {
        result += float(index % 3u) * digit;
        digit /= 3.0f;
        index /= 3u;
    }
    return min(result, 0.99999994f);
}

AG_FUNCTION vec2 halton23(uint index) {
    return vec2(radicalInverse2(index), radicalInverse3(index));
}

AG_FUNCTION vec2 hammersley(uint i, uint n) {
    return vec2((float(i) + 0.5f) / float(n), radicalInverse2(i));
}

// A permutation-congruential mixer: neighbours in, unrelated numbers out.
AG_FUNCTION uint hashUint(uint x) {
    x = x * 747796405u + 2891336453u;
    uint word = ((x >> ((x >> 28u) + 4u)) ^ x) * 277803737u;
    return (word >> 22u) ^ word;
}

AG_FUNCTION float hashToUnit(uint x) {
    return unitOf(hashUint(x));
}

// Two unit vectors that make a right-handed frame with n.
AG_FUNCTION void orthonormalBasis(vec3 n, AG_OUT(vec3) t, AG_OUT(vec3) b) {
    float s = n.z >= 0.0f ? 1.0f : -1.0f;
    float a = -1.0f / (s + n.z);
    float c = n.x * n.y * a;
    t = vec3(1.0f + s * n.x * n.x * a, s * c, -s * n.x);
    b = vec3(c, s + n.y * n.y * a, -n.y);
}

// As likely as its cosine to the unit normal.
AG_FUNCTION vec3 cosineDirection(vec3 n, vec2 xi) {
    vec3 t, b;
    orthonormalBasis(n, t, b);
    float radius = sqrt(xi.x), angle = 2.0f * kPi * xi.y;
    return t * (radius * cos(angle)) + b * (radius * sin(angle)) + n * sqrt(max(1.0f - xi.x, 0.0f));
}

AG_END
#endif
