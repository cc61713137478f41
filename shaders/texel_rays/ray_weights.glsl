// Two ways to find a surface that a texel stands for: a draw of the texel, through a place of its square, and the
// hemisphere's ray. Each counts by its share of both densities (balance heuristic, Veach & Guibas 1995). A pair of texel and
// direction has the same two densities whichever ray found it, so the shares add up to 1. Before: the push constants of
// cast_rays.comp and its buffers of texels, members and chances.
#ifndef AG_RAY_WEIGHTS_GLSL
#define AG_RAY_WEIGHTS_GLSL

#include "cluster_members/aim.glsl"
#include "rsm/texel_square.glsl"

const float kResampled = 4.0;   // by how much resampling makes a texel with much to send likelier
const float kAboutTexel = 2.0;  // sides: so far from a texel's middle a ray may meet what it stands for

struct Receiver {
    vec3 position, normal;
    vec3 start;        // of its rays
    float offset;      // m: rays leave so far before it
    uint tile, block;  // of the screen
};

// Whether the hemisphere's ray may meet what a texel stands for. Else draws have all of it.
bool bothFind(Receiver r, uint map, RsmSurface s) {
    return map < push.p.mapCount && distance(s.position, r.position) + kAboutTexel * sqrt(s.area) < push.p.reach;
}

// About how likely one texel of a light with so many is drawn.
float chanceOfTexel(float ofLight, uint memberCount) { return ofLight * kResampled / float(max(memberCount, 1)); }

// `throughSquare`: density of the direction, given the texel, per steradian.
float shareOfDraw(Receiver r, vec3 direction, float throughSquare, float chance) {
    float draw = chance * throughSquare;
    return draw > 0.0 ? draw / (draw + max(dot(r.normal, direction), 0.0) * kInvPi) : 0.0;
}

// What a texel sends to the receiver over its flux, if nothing stands between, 1/m².
float factorOf(Receiver r, RsmSurface s) { return factorOf(r.position, r.normal, s); }

// The same of draws alone.
float drawnFactorOf(Receiver r, uint map, RsmSurface s) {
    float reach = map == push.p.emissiveMap ? push.p.emissiveReach : map == push.p.laterMap ? push.p.laterReach : 0.0;
    float ofNear = map == push.p.laterMap ? s.cosine : 1.0;  // where the hemisphere's ray ends, that of lights without maps is not asked for
    return factorOf(r, s) * (1.0 - ofNear * nearShare(distance(s.position, r.position), reach));
}

// Mean of the channels of what a texel sends, times about the draws' share of it: never 0 where it sends anything.
float wantOf(Receiver r, uint map, RsmSurface s, float chance) {
    const float kLeastShare = 1e-3;
    float want = drawnFactorOf(r, map, s) * s.weight;
    if (!bothFind(r, map, s)) return want;
    vec3 d = s.position - r.start;
    float d2 = dot(d, d), cosine = -dot(d, s.normal) * inversesqrt(d2);
    float throughSquare = d2 / (max(cosine, 1e-4) * s.area);
    return want * max(shareOfDraw(r, d * inversesqrt(d2), throughSquare, chance), kLeastShare);
}

// Of what the hemisphere's ray found: all that no draw finds, and the rest of the others.
float shareOfNear(Receiver r, uint map, uint texel, vec3 direction) {
    if (texel == kNoTexel) return 1.0;
    TexelView v = viewTexel(texel, map, push.p.atlasWidth);
    if (!bothFind(r, map, v.s)) return 0.0;
    SquareCrossing c = crossSquare(v, r.start, direction);
    if (!inSquare(c.aside) || factorOf(r, v.s) <= 0.0) return 1.0;
    uint slot = fetchTexel(slotOfTexel, int(texel)).x;
    uint light = fetchTexel(candidates, int(texel / (kRsmTileSize * kRsmTileSize) * kMaxCandidates + slot)).x;
    float ofLight = fetchTexel(likely, int(r.block * push.p.tiles.valCount + light)).x;
    return 1.0 - shareOfDraw(r, direction, c.density, chanceOfTexel(ofLight, fetchTexel(memberRanges, int(light * 2 + 1)).x));
}
#endif
