#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// What a specular lobe reflects of surfaces, by two rays a pixel. One is drawn by the lobe and takes the light of what it meets. That
// shines by itself, or is lit by lamps, which a ray each asks for, and by what other surfaces and the sky send, of which one is
// drawn. The other goes to a texel of lit or emissive surfaces, drawn by what the lobe would reflect of it (resampling). What both
// may find counts by the share of their densities (balance heuristic). Light that goes on among near surfaces follows a path of rays
// (near_path.glsl). Sky that the lobe sees has rays of its own (sky/cast.comp).
#include "common/specular_lobe.glsl"
#include "common/texels.glsl"
#include "gbuffer/gbuffer.glsl"
#include "gloss_rays/gloss_rays_io.h"
#include "later_bounces/later_bounces_io.h"
#include "rsm/rsm_io.h"
#include "sky/sky_io.h"
#include "val_clustering/val_clustering_io.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push { GlossCastPush p; } push;

layout(set = 0, binding = 0, scalar) uniform Camera { CameraConstants camera; } camera;
layout(set = 0, binding = 1) uniform sampler2D normalMap;
layout(set = 0, binding = 2) uniform sampler2D depthMap;
layout(set = 0, binding = 3) uniform sampler2D reflectanceMap;  // head on; at grazing angles
layout(set = 0, binding = 4) VEC4_TEXELS(texels);
layout(set = 0, binding = 5, scalar) uniform Faces { RsmFace items[kMaxRsmFaces]; } faces;
layout(set = 0, binding = 6, scalar) uniform Maps { RsmMap items[kMaxRsmMaps]; } maps;
layout(set = 0, binding = 7) UINT_TEXELS(memberRanges);
layout(set = 0, binding = 8) UINT_TEXELS(members);
layout(set = 0, binding = 9) UINT_TEXELS(slotOfTexel);
layout(set = 0, binding = 10) UVEC4_TEXELS(treeNodes);
layout(set = 0, binding = 11, scalar) readonly buffer TreeTriangles { vec4 items[]; } treeTriangles;
layout(set = 0, binding = 12) UVEC4_TEXELS(treePlaces);
layout(set = 0, binding = 13) UVEC4_TEXELS(moverNodes);
layout(set = 0, binding = 14) UINT_TEXELS(noise);  // two 16-bit shares each
layout(set = 0, binding = 15, rgba32f) uniform writeonly image2D sent;  // W/(m² sr)
layout(set = 0, binding = 16, scalar) readonly buffer Lights { PointLight items[]; } lights;
layout(set = 0, binding = 17) VEC4_TEXELS(skyTexels);
layout(set = 0, binding = 18, scalar) uniform SkyUpTo { vec4 items[kSkyCells / 4]; } skyUpTo;
layout(set = 0, binding = 19) uniform sampler2D rsmNormals;
layout(set = 0, binding = 20) uniform sampler2D rsmAlbedos;
layout(set = 0, binding = 21, scalar) readonly buffer TileMaps { uint items[]; } tileMaps;
layout(constant_id = 0) const bool kBounces = true;  // light goes on after its first bounce
layout(constant_id = 1) const bool kSky = false;
layout(constant_id = 2) const bool kTexelLobes = false;
layout(constant_id = 3) const bool kEndless = true;  // light goes on after its second bounce

#define AG_BVH_MOVERS
#include "bvh/trace.glsl"
#include "cluster_members/aim.glsl"
#include "later_bounces/arriving.glsl"
#include "texel_rays/met_surface.glsl"
#include "gbuffer/pixel_start.glsl"
#define AG_SKY_UP_TO(cell) skyUpTo.items[(cell) / 4][(cell) % 4]
#include "texel_rays/incident.glsl"

const uint kDraws = 16;      // texels that one is resampled from, of what lights a place,
const uint kLobeDraws = 32;  // and of what a lobe sees

// Members of lights: of first bounces and emissive surfaces, which draws go to, then of points that reflect.
uvec3 kinds;

// One member of a kind, drawn. Members nearer than `nearReach` fade out: a ray into the hemisphere finds those surfaces.
Incident fromMembers(uint kind, vec3 place, vec3 normal, float nearReach, inout uint random) {
    if (kinds[kind] == kinds[kind + 1]) return kNoIncident;
    Aim aim = aimAtMember(place, normal, kinds[kind], kinds[kind + 1], kDraws, nearReach, random);
    return Incident(aim.place - (place + normal * push.p.offset), 1.0, aim.sends);
}

// One by what each sends, for all.
Incident fromOtherLights(vec3 place, vec3 normal, inout uint random) {
    Incident drawn = kNoIncident;
    float sum = 0.0, wanted = 1.0;
    for (uint i = 0; i < push.p.lightCount; ++i) {
        Arriving a = arrivingFrom(lights.items[i], place, normal);
        float want = most(a.irradiance);
        sum += want;
        random = hashUint(random);
        if (want <= 0.0 || (1.0 - unitOf(random)) * sum > want) continue;
        drawn = Incident(a.toLight, a.distance, a.irradiance);
        wanted = want;
    }
    drawn.sends *= sum / wanted;
    return drawn;
}

const uint kLater = 1;  // kind of members that are points; lights without maps come after them

Incident drawOnto(uint kind, vec3 place, vec3 normal, inout uint random) {
    if (kind > kLater) return fromOtherLights(place, normal, random);
    if (kind == kLater && !kEndless) return kNoIncident;
    return fromMembers(kind, place, normal, kind == kLater ? push.p.laterReach : 0.0, random);
}

#define AG_ON_KINDS 3
#define AG_ON_DRAW(kind, place, normal, random) drawOnto(kind, place, normal, random)
#define AG_ON_SHINES 0.0
#define AG_ON_REFLECTS (kEndless ? push.p.laterReach : 0.0)
#include "texel_rays/near_path.glsl"

// Of what a draw may find, the part that counts if it does: each texel is as likely a candidate as any. `across`: the texel's area
// as it is seen from the pixel, m².
float shareOfDraw(SpecularLobe lobe, vec3 direction, float distance_, float across) {
    if (kinds.y == 0) return 0.0;
    float draw = float(kLobeDraws) / float(kinds.y) * distance_ * distance_ / max(across, 1e-12);
    return draw / (draw + densityOfLobeRay(lobe, direction));
}

// W/(m² sr), of what the lobe's ray met.
vec3 radianceOf(BvhRay ray, SpecularLobe lobe, inout uint random) {
    Met met = surfaceMet(ray);
    if (!met.front) return vec3(0.0);
    met.masked = false;  // a leaf is lit where it is met, whether or not a texel stands for it
    float facing = abs(dot(met.normal, ray.direction));
    vec3 sends = met.shines * (1.0 - shareOfDraw(lobe, ray.direction, ray.reach, push.p.emissiveArea * facing));
    for (uint map = 0; map < push.p.mapCount; ++map) {
        Sender from = senderAt(map, met, ray, push.p.atlasWidth);
        if (from.sends == vec3(0.0) || !isLit(maps.items[map], met, push.p.offset, ray.opaqueFrom)) continue;
        float area = from.texel != kNoTexel ? AG_RSM_FETCH(texels, from.texel).area : 0.0;
        sends += from.sends * (area > 0.0 ? 1.0 - shareOfDraw(lobe, ray.direction, ray.reach, area * facing) : 1.0);
    }
    if (kBounces && met.reflectance != vec3(0.0)) sends += lightFrom(met, min(met.reflectance, vec3(kMostAlbedo)), ray.opaqueFrom, random);
    return sends * kInvPi;
}

// Radiance toward the viewer of what a texel sends, if that is diffuse and nothing stands between.
vec3 reflectedOf(SpecularLobe lobe, vec3 place, uint texel, RsmSurface s) {
    float factor = factorOf(place, lobe.normal, s);
    if (factor <= 0.0) return vec3(0.0);
    vec3 d = s.position - place;
    float distance_ = max(length(d), 1e-6);
    vec3 toward = d / distance_;
    // As the lobe's ray takes it: that does not know which point a place belongs to.
    float area = maps.items[mapOfTexel(texel)].kind == kMapOfSurfaces ? push.p.emissiveArea : s.area;
    float share = shareOfDraw(lobe, toward, distance_, area * max(-dot(s.normal, toward), 0.0));
    return lobeBrdf(lobe, toward) * s.flux * (factor * share);
}

vec3 reflectedOfDrawn(SpecularLobe lobe, PixelStart start, vec3 origin, float opaqueFrom, inout uint random) {
    if (kinds.y == 0) return vec3(0.0);
    MemberDraw d = MemberDraw(kNoTexel, 0.0, 0.0);
    AG_DRAW_MEMBER(d, 0u, kinds.y, kLobeDraws, random, meanOf(reflectedOf(lobe, start.place, texel_, s)))
    if (d.sum <= 0.0) return vec3(0.0);
    RsmSurface s = AG_RSM_FETCH(texels, d.texel);
    BvhRay ray = BvhRay(origin, endBefore(s) - origin, 1.0, opaqueFrom, true, 0, 0);
    if (traceOccluders(ray)) return vec3(0.0);
    vec3 reflects = reflectedOf(lobe, start.place, d.texel, s) * sentTo(start.place, d.texel, s, push.p.atlasWidth);
    return reflects * weightOf(d, kinds.y, kLobeDraws);
}

vec2 noiseAt(ivec2 pixel) { return unpackUnorm2x16(fetchTexel(noise, (pixel.y & 63) * 64 + (pixel.x & 63)).x); }

vec3 reflected(ivec2 pixel, float depth, vec4 reflectance) {
    PixelStart start = startOf(pixel, depth);
    SpecularLobe lobe = specularLobe(texelFetch(normalMap, pixel, 0), normalize(camera.camera.position - start.place), reflectance);
    LobeRay r = drawLobeRay(lobe, fract(noiseAt(pixel) + push.p.shift.xy));
    uint random = hashUint(uint(pixel.x) + uint(pixel.y) * 65536u + hashUint(push.p.step) * 31u);
    vec3 origin = start.place + lobe.normal * start.offset;
    BvhRay ray = BvhRay(origin, r.direction, push.p.reach, unitOf(random), false, 0, 0);
    vec3 found = vec3(0.0);
    if (r.weight != vec3(0.0) && traceOccluders(ray)) found = r.weight * radianceOf(ray, lobe, random);
    return found + reflectedOfDrawn(lobe, start, origin, ray.opaqueFrom, random);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(sent)))) return;
    float depth = texelFetch(depthMap, pixel, 0).x;
    vec4 reflectance = texelFetch(reflectanceMap, pixel, 0);
    vec3 found = vec3(0.0);
    kinds = kindsOfMembers(push.p.firstLater, push.p.valCount);
    if (depth > 0.0 && reflectance.w > 0.0) found = reflected(pixel, depth, reflectance);
    imageStore(sent, pixel, vec4(min(found, vec3(kMostHalf)), 1.0));
}
