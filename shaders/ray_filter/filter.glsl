// One round of an edge-avoiding à-trous filter (Dammertz et al. 2010) that knows its variance (Schied et al. 2017): over pixels
// on the same surface whose light differs by no more than noise. Before, by pixel: `surfaceOf` (normal; m along the axis, 0:
// sky) and `lightOf` (W/m²; a: variance, mean of its channels).
#include "common/pixel_rays.h"
#include "ray_filter/ray_filter_io.h"

const float kSpline[3] = float[](0.375, 0.25, 0.0625);

// `pixelSize`: m at 1 m depth.
vec4 filtered(ivec2 at, ivec2 size, PixelRays rays, float pixelSize, RayFilterPush p) {
    vec4 s = surfaceOf(at), here = lightOf(at);
    vec3 place = placeOf(rays, vec2(at), s.w);
    float footprint = pixelSize * max(s.w, 1e-3) * 2.0;
    vec4 sum = vec4(0.0);
    float total = 0.0;
    [[unroll]] for (int y = -2; y <= 2; ++y)
        [[unroll]] for (int x = -2; x <= 2; ++x) {
            ivec2 tap = at + ivec2(x, y) * p.stride, there = clamp(tap, ivec2(0), size - 1);
            vec4 other = surfaceOf(there), r = lightOf(there);
            float like = likeness(s.xyz, placeOf(rays, vec2(there), other.w) - place, footprint, other.xyz);
            vec3 off = r.rgb - here.rgb;
            float over = meanProduct(off, off) / (p.tolerance * p.tolerance * (here.a + r.a) + 1e-20);
            float weight = kSpline[abs(x)] * kSpline[abs(y)] * like / (1.0 + over * over);
            weight = tap == there && other.w > 0.0 ? weight : 0.0;
            sum += vec4(weight * r.rgb, weight * weight * r.a);
            total += weight;
        }
    return s.w > 0.0 && total > 0.0 ? vec4(sum.rgb / total, sum.a / (total * total)) : vec4(0.0);
}
