#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
// How much of the control's known error to take off the rays' (regression on a control variate): all of it where area lights
// and rays go together, nothing where shadow maps leak. By moments of the pixels about on the same surface. What is left is
// filtered.
#include "common/pixel_rays.h"
#include "texel_rays/texel_rays_io.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push { RegressPush p; } push;

layout(set = 0, binding = 0) uniform sampler2D areaLights;
layout(set = 0, binding = 1) uniform sampler2D sentMean;
layout(set = 0, binding = 2) uniform sampler2D controlMean;  // less the area lights' sum
layout(set = 0, binding = 3) uniform sampler2D moments;
layout(set = 0, binding = 4) uniform sampler2D surface;
layout(set = 0, binding = 5, scalar) uniform Cameras { ReprojectionCameras c; } cameras;
layout(set = 0, binding = 6, rgba32f) uniform writeonly image2D rest;  // rgb: W/m²; a: variance, mean of its channels
layout(set = 0, binding = 7, r32f) uniform writeonly image2D shareOf;  // of the area lights' sum to add to it

const int kReach = 2;             // pixels about
const float kLeastSpread = 0.01;  // of the squared mean: few samples may all be alike by chance
const float kMostSurprise = 0.3;  // how far the share of detail may be from what moments say, as a deviation

struct Window {
    vec3 central;                // second moments about each pixel's means: of rays; both; of control
    vec3 lights, sent, control;  // means, W/m²
    vec3 withLights;             // of the mean products of each and area lights
    float total, count;
};

// Central second moments of a pixel: of rays; both; of control.
vec3 centralAt(ivec2 at, vec3 sent, vec3 control) {
    return texelFetch(moments, at, 0).xyz - vec3(meanProduct(sent, sent), meanProduct(sent, control), meanProduct(control, control));
}

vec3 productsWith(vec3 lights, vec3 sent, vec3 control) {
    return vec3(meanProduct(lights, lights), meanProduct(sent, lights), meanProduct(control, lights));
}

Window windowAbout(ivec2 at, vec4 s, ivec2 size) {
    vec3 place = placeOf(cameras.c.now, vec2(at), s.w);
    float footprint = cameras.c.pixelSize * max(s.w, 1e-3) * 2.0;
    Window w = Window(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0);
    [[unroll]] for (int y = -kReach; y <= kReach; ++y)
        [[unroll]] for (int x = -kReach; x <= kReach; ++x) {
            ivec2 there = clamp(at + ivec2(x, y), ivec2(0), size - 1);
            vec4 other = texelFetch(surface, there, 0), sent = texelFetch(sentMean, there, 0);
            float like = likeness(s.xyz, placeOf(cameras.c.now, vec2(there), other.w) - place, footprint, other.xyz);
            float weight = other.w > 0.0 ? like * sent.a : 0.0;
            vec3 lights = texelFetch(areaLights, there, 0).rgb, control = lights + texelFetch(controlMean, there, 0).rgb;
            w.central += weight * centralAt(there, sent.rgb, control);
            w.lights += weight * lights, w.sent += weight * sent.rgb, w.control += weight * control;
            w.withLights += weight * productsWith(lights, sent.rgb, control);
            w.total += weight;
            w.count += other.w > 0.0 ? like : 0.0;
        }
    float share = 1.0 / max(w.total, 1e-20);
    w.lights *= share, w.sent *= share, w.control *= share, w.withLights *= share;
    w.central = max(w.central, vec3(0.0)) / max(w.total - w.count, 1e-20);  // of n samples n - 1 are free
    return w;
}

// Second moments of rays; both; of control: of what is left of rays.
float spreadOf(vec3 m, float share) { return m.x - 2.0 * share * m.y + share * share * m.z; }

void main() {
    ivec2 size = imageSize(rest), pixel = ivec2(gl_GlobalInvocationID.xy), at = min(pixel, size - 1);
    Window w = windowAbout(at, texelFetch(surface, at, 0), size);
    vec4 sent = texelFetch(sentMean, at, 0);
    vec3 lights = texelFetch(areaLights, at, 0).rgb, control = lights + texelFetch(controlMean, at, 0).rgb;
    float share = w.central.z > 0.0 ? clamp(w.central.y / w.central.z, 0.0, 1.0) : 1.0;
    float n = max(sent.a, 1.0), few = push.p.few / n, e2 = meanProduct(w.sent, w.sent);
    // A firefly has a large variance of its own; narrow real light has not.
    vec3 own = max(centralAt(at, sent.rgb, control), vec3(0.0)) * (n / max(n - 1.0, 1.0));
    float spread = max(spreadOf(w.central, share), spreadOf(own, share));
    float variance = max(spread, kLeastSpread * e2 + 1e-12) / n + few * few * few * few * e2;
    // What is left of the rays follows the lights' sum from pixel to pixel by so much.
    vec3 together = w.withLights - productsWith(w.lights, w.sent, w.control);
    float sure = w.count / variance, expected = 1.0 / (kMostSurprise * kMostSurprise);
    float detail = ((together.y - share * together.z) * sure + (1.0 - share) * expected) / (together.x * sure + expected);
    detail = clamp(detail, 0.0, 1.0 - share);
    vec3 left = sent.rgb - share * control - detail * lights;
    if (any(greaterThanEqual(pixel, size))) return;
    imageStore(rest, pixel, vec4(left, variance));
    imageStore(shareOf, pixel, vec4(share + detail));
}
