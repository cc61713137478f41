// A texel drawn of many lights' by what it would send to a place, and a ray to its middle. Before: what draw_member.glsl needs;
// what texel_lobe.glsl needs; push.p.atlasWidth, push.p.offset and push.p.texelOffset (m, and in texels: rays end so far before
// surfaces).
#ifndef AG_AIM_GLSL
#define AG_AIM_GLSL

#include "bvh/met.glsl"
#include "cluster_members/texel_factor.glsl"

vec3 endBefore(RsmSurface s) { return s.position + s.normal * max(push.p.offset, push.p.texelOffset * sqrt(s.area)); }

struct Aim {
    vec3 place;
    vec3 sends;  // W/m², of all members by this draw, if nothing stands between
};

// The same of what a ray into the hemisphere leaves that has all that is nearer than `reach`, but for lights without maps.
float factorOfFar(vec3 place, vec3 normal, RsmSurface s, float reach) {
    float ofNear = reach > 0.0 ? s.cosine * nearShare(distance(s.position, place), reach) : 0.0;
    return factorOf(place, normal, s) * (1.0 - ofNear);
}

// Of members [first, end).
Aim aimAtMember(vec3 place, vec3 normal, uint first, uint end, uint draws, float reach, inout uint random) {
    MemberDraw d = MemberDraw(0, 0.0, 0.0);
    AG_DRAW_MEMBER(d, first, end - first, draws, random, factorOfFar(place, normal, s, reach) * s.weight)
    if (d.sum <= 0.0) return Aim(place, vec3(0.0));
    RsmSurface s = AG_RSM_FETCH(texels, d.texel);
    vec3 sends = s.flux * sentTo(place, d.texel, s, push.p.atlasWidth);
    return Aim(endBefore(s), sends * (factorOfFar(place, normal, s, reach) * weightOf(d, end - first, draws)));
}

uint endOfMembers(uint endLight) { return firstMember(endLight - 1) + fetchTexel(memberRanges, int(endLight * 2 - 1)).x; }

// Members of all lights in two kinds: of first bounces and emissive surfaces, of points that reflect. Where each begins, and the
// end.
uvec3 kindsOfMembers(uint firstLater, uint lightCount) {
    uint end = endOfMembers(lightCount);
    return uvec3(0, firstLater < lightCount ? firstMember(firstLater) : end, end);
}
#endif
