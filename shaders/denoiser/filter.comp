#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
// One round of the edge-avoiding à-trous filter (Dammertz et al. 2010): five taps along a line, or 25 in a square, on the
// same surface and, where the mean is certain, of like light. Weights of a B3 spline.
#include "denoiser/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push { FilterPush p; } push;

layout(constant_id = 0) const bool kSquare = false;
layout(set = 0, binding = 0) uniform sampler2D light;
layout(set = 0, binding = 1) uniform sampler2D surface;
layout(set = 0, binding = 2) uniform sampler2D tiles;
layout(set = 0, binding = 3, scalar) uniform Cameras { ReprojectionCameras c; } cameras;
layout(set = 0, binding = 4, rgba16f) uniform writeonly image2D result;

const float kSpline[3] = float[](0.375, 0.25, 0.0625);

void main() {
    ivec2 size = imageSize(result), pixel = ivec2(gl_GlobalInvocationID.xy), at = min(pixel, size - 1);
    PixelRays rays = cameras.c.now;
    vec4 s = texelFetch(surface, at, 0), here = texelFetch(light, at, 0);
    vec3 place = placeOf(rays, vec2(at), s.w);
    float footprint = cameras.c.pixelSize * max(s.w, 1e-3) * 2.0;
    vec2 where = (vec2(at) + 0.5) / float(kDenoiserTile) / vec2(textureSize(tiles, 0));
    float l = luminance(here.rgb), noise = textureLod(tiles, where, 0.0).x * inversesqrt(max(here.a, 1.0));
    float tolerance = push.p.lightTolerance > 0.0 ? push.p.lightTolerance * noise + 0.01 * l + 1e-9 : 3.0e38;
    vec4 sum = here * (kSquare ? kSpline[0] * kSpline[0] : kSpline[0]);
    float total = kSquare ? kSpline[0] * kSpline[0] : kSpline[0];
    [[unroll]] for (int y = kSquare ? -2 : 0; y <= (kSquare ? 2 : 0); ++y)
        [[unroll]] for (int x = -2; x <= 2; ++x) {
            if (x == 0 && y == 0) continue;
            ivec2 tap = at + (kSquare ? ivec2(x, y) : ivec2(x)) * ivec2(push.p.strideX, push.p.strideY);
            bool inside = all(greaterThanEqual(tap, ivec2(0))) && all(lessThan(tap, size));
            ivec2 there = clamp(tap, ivec2(0), size - 1);
            vec4 other = texelFetch(surface, there, 0), lit = texelFetch(light, there, 0);
            float like = likeness(s.xyz, placeOf(rays, vec2(there), other.w) - place, footprint, other.xyz);
            float off = (luminance(lit.rgb) - l) / tolerance;
            float weight = (kSquare ? kSpline[abs(x)] * kSpline[abs(y)] : kSpline[abs(x)]) * like / (1.0 + off * off);
            weight = inside && other.w > 0.0 ? weight : 0.0;
            sum += weight * lit;
            total += weight;
        }
    vec4 mean = s.w > 0.0 ? vec4(roundedByChance(sum.rgb / total, at, push.p.seed), here.a) : vec4(0.0);
    if (all(lessThan(pixel, size))) imageStore(result, pixel, mean);
}
