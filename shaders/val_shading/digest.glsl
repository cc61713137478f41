// Whether a workgroup's pixels are what they were when they were gathered last: by a number of all they are. Needs
// buffers `digests` and `previousDigests`, and the constants `push`.
#ifndef AG_DIGEST_GLSL
#define AG_DIGEST_GLSL

#include "common/sampling.h"

shared uvec2 sharedDigest;

// Of any order of the pixels: sums of well mixed words. Two, as one in four billion changes would be missed by one.
void addToDigest(uint place, uvec4 what) {
    uint a = hashUint(place + 1u);
    for (int i = 0; i < 4; ++i) a = hashUint(a ^ what[i]);
    atomicAdd(sharedDigest.x, a);
    atomicAdd(sharedDigest.y, hashUint(a ^ what.x ^ 0x9e3779b9u));
}

uvec4 surfaceWords(float depth, vec4 normalAndRoughness) {
    return uvec4(floatBitsToUint(depth), packHalf2x16(normalAndRoughness.xy), packHalf2x16(normalAndRoughness.zw), 0u);
}

// Of every count-th tile the index-th ones: no two next to each other, in no row or column.
bool isDue(uint tile) {
    uvec2 at = uvec2(tile % push.p.gather.tiles.x, tile / push.p.gather.tiles.x);
    return (at.x + 2u * at.y) % push.p.count == push.p.index;
}

// One invocation of the workgroup, after all have added theirs.
bool takeDigest(uint group) {
    bool other = previousDigests.items[group] != sharedDigest;
    digests.items[group] = sharedDigest;
    return other;
}
#endif
