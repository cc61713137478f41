// One texel of many by what it would send (resampled importance sampling, Talbot et al. 2005). Before: VEC4_TEXELS texels,
// UINT_TEXELS memberRanges and members.
#ifndef AG_DRAW_MEMBER_GLSL
#define AG_DRAW_MEMBER_GLSL

#include "common/sampling.h"
#include "rsm/rsm.glsl"

struct MemberDraw {
    uint texel;
    float sum, wanted;  // of what all candidates would send, and the one drawn; 0: nothing was drawn
};

// Of what the drawn texel sends, so that its mean is the sum over all `count`.
float weightOf(MemberDraw d, uint count, uint draws) { return d.sum > 0.0 ? d.sum * float(count) / (float(draws) * d.wanted) : 0.0; }

uint firstMember(uint light) { return fetchTexel(memberRanges, int(light * 2)).x; }

// A candidate that wants `want` and counts for `weight`. None whose weight is less than 2^-24 of the sum is drawn, so that
// weights stay finite.
void take(inout MemberDraw d, uint texel, float want, float weight, inout uint random) {
    d.sum += weight;
    random = hashUint(random);
    bool taken = weight > 0.0 && (1.0 - unitOf(random)) * d.sum <= weight;
    d.texel = taken ? texel : d.texel;
    d.wanted = taken ? want : d.wanted;
}

// `draws` candidates at even steps of members [first, first + count). `want`: what the texel s would send, at least 0.
#define AG_DRAW_MEMBER(d, first, count, draws, random, want)                                                                    \
    {                                                                                                                           \
        float step_ = float(count) / float(draws);                                                                              \
        for (uint i_ = 0; i_ < (draws); ++i_) {                                                                                 \
            random = hashUint(random);                                                                                          \
            uint place_ = (first) + min(uint((float(i_) + unitOf(random)) * step_), (count) - 1);                               \
            uint texel_ = fetchTexel(members, int(place_)).x;                                                                   \
            RsmSurface s = AG_RSM_FETCH(texels, texel_);                                                                        \
            float want_ = (want);                                                                                               \
            take(d, texel_, want_, want_, random);                                                                              \
        }                                                                                                                       \
    }
#endif
