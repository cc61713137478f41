#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// What the sky sends to the points that stand for all surfaces when light bounces on: a few rays more to their means.
#include "common/sampling.h"
#include "common/texels.glsl"
#include "rsm/rsm_io.h"
#include "sky/sky_io.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { SkyPointsPush p; } push;

layout(set = 0, binding = 0) VEC4_TEXELS(texels);  // RsmTexel
layout(set = 0, binding = 1) VEC4_TEXELS(skyTexels);
layout(set = 0, binding = 2, scalar) readonly buffer UpTo { float items[]; } upTo;
layout(set = 0, binding = 3) VEC4_TEXELS(before);
layout(set = 0, binding = 4, scalar) writeonly buffer Irradiance { vec4 items[]; } irradiance;  // rgb: W/m²; a: rays
layout(set = 0, binding = 5) UVEC4_TEXELS(treeNodes);
layout(set = 0, binding = 6) UVEC4_TEXELS(moverNodes);
layout(set = 0, binding = 7) UVEC4_TEXELS(treePlaces);
layout(set = 0, binding = 8, scalar) readonly buffer Triangles { vec4 items[]; } treeTriangles;
#define AG_BVH_MOVERS
#include "bvh/trace.glsl"
#define AG_SKY_UP_TO(cell) upTo.items[cell]
#include "sky/draw.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.p.count) return;
    vec3 place = fetchTexel(texels, int(i) * 3).xyz, normal = fetchTexel(texels, int(i) * 3 + 1).xyz, sum = vec3(0.0);
    vec4 mean = push.p.valid == 1 ? fetchTexel(before, int(i)) : vec4(0.0);
    vec3 own = vec3(hashToUnit(3 * i), hashToUnit(3 * i + 1), hashToUnit(3 * i + 2));
    for (uint r = 0; r < push.p.rays; ++r) {
        uint n = push.p.step * push.p.rays + r;
        // Multiples of inverse powers of the root of x^4 = x + 1 (Roberts 2018), in whole numbers.
        uvec3 turns = n * uvec3(0xd1b54a33u, 0xabc98389u, 0x8cb92ba7u);
        SkyDraw d = drawSky(fract(own + vec3(turns >> 8) / 16777216.0));
        float cosine = dot(normal, d.direction);
        if (cosine <= 0.0 || d.density <= 0.0) continue;
        BvhRay ray = BvhRay(place + normal * push.p.offset, d.direction, push.p.reach, hashToUnit(i + n * 31u), true, 0, 0);
        if (!traceOccluders(ray)) sum += d.radiance * (cosine / d.density);
    }
    float rays = min(mean.a, push.p.mostLength - float(push.p.rays)) + float(push.p.rays);
    irradiance.items[i] = vec4(mix(mean.rgb, sum / float(push.p.rays), float(push.p.rays) / rays), rays);
}
