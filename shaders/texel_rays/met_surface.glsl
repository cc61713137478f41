// What a map's light makes send what a ray met. Before: the buffers of rsm_lookup.glsl, slotOfTexel; what bvh/met.glsl and
// texel_lobe.glsl need.
#ifndef AG_MET_SURFACE_GLSL
#define AG_MET_SURFACE_GLSL

#include "bvh/met.glsl"
#include "rsm/texel_lobe.glsl"
#include "texel_rays/rsm_lookup.glsl"

const float kAlike = 0.8;  // least cosine between normals of a texel and a triangle that receive the same irradiance

// Whether a map's light reaches a place: a texel says it only about its middle.
bool isLit(RsmMap map, Met met, float offset, float opaqueFrom) {
    vec3 start = met.place + met.normal * offset;
    bool sun = map.kind == kLightDirectional;
    BvhRay ray = BvhRay(start, sun ? -map.direction : map.position - start, sun ? 1e20 : 1.0, opaqueFrom, true, 0, 0);
    return !traceOccluders(ray);
}

// What a map's light makes a place send to where the ray came from if it reaches the place: the W/m² of a diffuse surface that looks as
// bright from there. In a crease and on what is narrower than a texel no texel
// stands for the place. There the triangle's reflectance counts, but not a masked triangle's: light passes through it, so
// that few of its places have texels, and draws count those.
struct Sender {
    uint texel;  // that stands for the place, or kNoTexel: no draw finds it
    vec3 sends;
};

Sender senderAt(uint map, Met met, BvhRay ray, uint atlasWidth) {
    MapPlace p = placeInMap(maps.items[map], met.place);
    if (!p.inside && maps.items[map].kind == kLightDirectional) return Sender(kNoTexel, vec3(0.0));  // another level has it
    uint texel = texelAt(p, atlasWidth, met.place, met.normal);
    texel = texel != kNoTexel && fetchTexel(slotOfTexel, int(texel)).x == kNoCluster ? kNoTexel : texel;
    vec3 along = vec3(1.0);
    if (texel != kNoTexel) {
        RsmSurface s = AG_RSM_FETCH(texels, texel);
        along = sentToward(texel, met.place, s.normal, -ray.direction, atlasWidth);
        if (dot(s.normal, met.normal) >= kAlike || met.masked || met.reflectance == vec3(0.0)) return Sender(texel, along * s.flux / s.area);
    }
    return Sender(texel, met.masked ? vec3(0.0) : irradianceOf(maps.items[map], met.place, met.normal) * met.reflectance * along);
}
#endif
