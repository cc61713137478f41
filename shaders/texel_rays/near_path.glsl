// Light that goes on from what a ray met nearby: a path along surfaces that are near one another. Points of later bounces stand
// badly for what is near, so draws from each of these surfaces leave near points out, and a ray into its hemisphere finds what
// is there instead. Before: what bvh/met.glsl and texel_rays/incident.glsl need; push.p.offset;
//   AG_ON_KINDS                                   of draws from each surface
//   AG_ON_DRAW(kind, place, normal, random)       one of them: an Incident
//   AG_ON_SHINES, AG_ON_REFLECTS                  m: so near rays find what shines, and what reflects; 0: draws have all of it
#ifndef AG_NEAR_PATH_GLSL
#define AG_NEAR_PATH_GLSL

#include "bvh/met.glsl"
#include "later_bounces/later_bounces_io.h"
#include "texel_rays/incident.glsl"

const uint kNearLength = 8;  // surfaces one after another, at most

// What a surface that a ray met sends on of what it receives, as far as rays find it.
vec3 sendsOn(Met met, float far) { return met.front ? min(met.reflectance, vec3(kMostAlbedo)) * nearShare(far, AG_ON_REFLECTS) : vec3(0.0); }

const uint kToSky = AG_ON_KINDS, kToNear = AG_ON_KINDS + 1, kKindsOfRays = AG_ON_KINDS + 2;

// Begins at `at` with a ray of a kind; one to what is near goes along `direction`.
vec3 walkNear(Met at, uint kindOfFirst, vec3 direction, vec3 through, float opaqueFrom, inout uint random) {
    vec3 e = vec3(0.0);
    // A loop, so that the trees' walk is compiled once.
    for (uint i = kindOfFirst; i < kKindsOfRays * kNearLength; ++i) {
        uint kind = i % kKindsOfRays;
        Incident light = kNoIncident;
        if (kind == kToNear) light = Incident(direction, max(AG_ON_SHINES, AG_ON_REFLECTS), vec3(0.0));
        else if (kind < kToSky) light = AG_ON_DRAW(kind, at.place, at.normal, random);
        else if (kSky) light = drawSkyAt(at.normal, 1e20, random);
        if (kind != kToNear && light.sends == vec3(0.0)) continue;
        BvhRay ray = BvhRay(at.place + at.normal * push.p.offset, light.toward, light.reach, opaqueFrom, kind != kToNear, 0, 0);
        bool meets = traceOccluders(ray);
        if (!meets) e += through * light.sends;
        if (kind != kToNear) continue;
        if (!meets) break;
        at = surfaceMet(ray);
        if (!at.front) break;
        e += through * at.shines * nearShare(ray.reach, AG_ON_SHINES);
        vec3 sends = sendsOn(at, ray.reach);
        float goesOn = i == kindOfFirst ? 1.0 : max(sends.x, max(sends.y, sends.z));  // Russian roulette
        if (sends == vec3(0.0) || next(random) >= goesOn) break;
        through *= sends / goesOn;
        direction = cosineDirection(at.normal, vec2(next(random), next(random)));
    }
    return e;
}

// W/m², of what goes on from a surface that a ray met. `through`: what of it reaches where the ray began.
vec3 lightFrom(Met met, vec3 through, float opaqueFrom, inout uint random) {
    if (through == vec3(0.0)) return vec3(0.0);
    vec3 direction = cosineDirection(met.normal, vec2(next(random), next(random)));
    return walkNear(met, 0, direction, through, opaqueFrom, random);
}

// W/m², by a ray along `direction` from a place to what is near.
vec3 nearLight(vec3 place, vec3 normal, vec3 direction, float opaqueFrom, inout uint random) {
    return walkNear(Met(place, normal, true, vec3(0.0), false, vec3(0.0)), kToNear, direction, vec3(1.0), opaqueFrom, random);
}
#endif
