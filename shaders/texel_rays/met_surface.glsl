// What a ray meets, and what a map's light makes it send. Before: the buffers of rsm_lookup.glsl, treeTriangles,
// slotOfTexel, the trees and bvh/trace.glsl; what texel_lobe.glsl needs.
#ifndef AG_MET_SURFACE_GLSL
#define AG_MET_SURFACE_GLSL

#include "rsm/texel_lobe.glsl"
#include "texel_rays/rsm_lookup.glsl"

const float kAlike = 0.8;  // least cosine between normals of a texel and a triangle that receive the same irradiance

struct Met {
    vec3 place, normal;  // on the ray's side, unit
    bool front;          // it reflects light to where the ray came from
    vec3 reflectance;    // 0 of a triangle that shines
    bool masked;
    vec3 shines;         // W/m²
};

Met surfaceMet(BvhRay ray) {
    vec3 normal = normalize(triangleNormal(ray.triangle, ray.place));
    float front = treeTriangles.items[ray.triangle * 3 + 2].w, sends = treeTriangles.items[ray.triangle * 3 + 1].w;
    bool shines = front >= kEmissiveFront - 1.0;
    front -= shines ? kEmissiveFront : 0.0;
    bool behind = dot(normal, ray.direction) > 0.0;
    bool whole = treeTriangles.items[ray.triangle * 3].w >= 1.0;
    return Met(ray.origin + ray.direction * ray.reach, behind ? -normal : normal, front == 0.0 || (front < 0.0) == behind,
               shines ? vec3(0.0) : unpackReflectance(sends), !whole, shines ? unpackRadiance(sends) * kPi : vec3(0.0));
}

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
    uint texel = texelAt(map, atlasWidth, met.place, met.normal);
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
