#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// A ray a pixel to the sky, drawn by its block's choice; and what the block learns from its rays. Where a surface has a
// specular lobe a second one is drawn by that; what the lobe reflects counts both by how likely either was to find it
// (balance heuristic, Veach & Guibas 1995). A block a workgroup.
#include "common/specular_lobe.glsl"
#include "common/texels.glsl"
#include "gbuffer/gbuffer.glsl"
#include "sky/blocks.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { SkyCastPush p; } push;

layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2, scalar) uniform Camera { CameraConstants camera; } camera;
layout(set = 0, binding = 3) VEC4_TEXELS(skyTexels);
layout(set = 0, binding = 4, scalar) readonly buffer UpTo { float items[]; } upTo;
layout(set = 0, binding = 5, scalar) readonly buffer Before { vec2 items[]; } before;
layout(set = 0, binding = 6, scalar) writeonly buffer Seen { vec2 items[]; } seen;
layout(set = 0, binding = 7, rgba32f) uniform writeonly image2D sent;
layout(set = 0, binding = 8) UVEC4_TEXELS(treeNodes);
layout(set = 0, binding = 9) UVEC4_TEXELS(moverNodes);
layout(set = 0, binding = 10) UVEC4_TEXELS(treePlaces);
layout(set = 0, binding = 11, scalar) readonly buffer Triangles { vec4 items[]; } treeTriangles;
layout(set = 0, binding = 12) UINT_TEXELS(noise);  // two 16-bit shares each
layout(set = 0, binding = 13) uniform sampler2D reflectanceMap;           // head on; at grazing angles
layout(set = 0, binding = 14, rgba32f) uniform writeonly image2D shone;   // what specular lobes reflect, W/(m² sr)
layout(constant_id = 0) const bool kGlossy = false;
#define AG_BVH_MOVERS
#include "bvh/trace.glsl"
#include "gbuffer/pixel_start.glsl"
#define AG_SKY_UP_TO(cell) upTo.items[gl_WorkGroupID.x * kSkyCells + (cell)]
#include "sky/draw.glsl"

shared uint hits[kSkyCells], tries[kSkyCells];

void learn() {
    uint first = gl_WorkGroupID.x * kSkyCells;
    barrier();
    for (uint cell = gl_LocalInvocationID.x; cell < kSkyCells; cell += 64) {
        vec2 known = push.p.known == 1 ? before.items[first + cell] * push.p.keep : vec2(0.0);
        seen.items[first + cell] = known + vec2(hits[cell], tries[cell]);
    }
}

vec2 noiseAt(uvec2 pixel) {
    return unpackUnorm2x16(fetchTexel(noise, int((pixel.y & 63u) * 64u + (pixel.x & 63u))).x);
}

// Of a block: four by two for each eight invocations in a row.
uvec2 placeInBlock(uint i) { return uvec2((i & 3u) | (i >> 1 & 4u), (i >> 2 & 1u) | (i >> 3 & 6u)); }

// Of a lobe: its BRDF times the cosine.
vec3 lobeReflects(SpecularLobe c, vec3 toLight) { return lobeBrdf(c, toLight) * max(dot(c.normal, toLight), 0.0); }

bool reachesSky(vec3 place, vec3 direction, float opaqueFrom) {
    BvhRay ray = BvhRay(place, direction, push.p.reach, opaqueFrom, true, 0, 0);
    return !traceOccluders(ray);
}

void main() {
    for (uint cell = gl_LocalInvocationID.x; cell < kSkyCells; cell += 64) hits[cell] = tries[cell] = 0;
    barrier();
    uvec2 size = camera.camera.size;
    uvec2 at = skyBlockOrigin(gl_WorkGroupID.x, size) + placeInBlock(gl_LocalInvocationID.x);
    ivec2 pixel = ivec2(min(at, size - 1u));
    bool there = all(equal(uvec2(pixel), at));
    float depth = texelFetch(depthMap, pixel, 0).x;
    vec4 normalAndRoughness = texelFetch(normalMap, pixel, 0), reflectance = kGlossy ? texelFetch(reflectanceMap, pixel, 0) : vec4(0.0);
    vec3 normal = normalAndRoughness.xyz, xi = fract(vec3(noiseAt(at), noiseAt(at + 32u).x) + push.p.shift);
    PixelStart start = startOf(pixel, depth);
    vec3 place = start.place + normal * start.offset;
    SpecularLobe lobe = specularLobe(normalAndRoughness, normalize(camera.camera.position - start.place), reflectance);
    bool glossy = kGlossy && there && depth > 0.0 && reflectance.w > 0.0;
    SkyDraw d = drawSky(xi);
    float cosine = dot(normal, d.direction);
    vec3 e = vec3(0.0), shine = vec3(0.0);
    float opaqueFrom = hashToUnit(uint(pixel.x) + uint(pixel.y) * 65536u + hashUint(push.p.step) * 31u);
    if (there && depth > 0.0 && d.density > 0.0 && cosine > 0.0) {
        bool free = reachesSky(place, d.direction, opaqueFrom);
        atomicAdd(tries[d.cell], 1);
        if (free) {
            atomicAdd(hits[d.cell], 1);
            e = d.radiance * (cosine / d.density);
            if (glossy) shine = d.radiance * lobeReflects(lobe, d.direction) / (d.density + densityOfLobeRay(lobe, d.direction));
        }
    }
    if (glossy) {
        vec3 toLight = drawLobeRay(lobe, fract(xi.zy + vec2(0.5, 0.25))).direction;
        SkyDraw other = skyAlong(toLight);
        vec3 reflects = other.radiance * lobeReflects(lobe, toLight) / max(other.density + densityOfLobeRay(lobe, toLight), 1e-20);
        if (reflects != vec3(0.0) && reachesSky(place, toLight, opaqueFrom)) shine += reflects;
    }
    if (kGlossy && there) imageStore(shone, pixel, vec4(shine, 1.0));
    if (there) imageStore(sent, pixel, vec4(e, 1.0));
    learn();
}
