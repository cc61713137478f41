#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
// This frame's rays into the means that the frames before left on the same surface; and how uncertain those are. While
// things move, a block whose rays find more or less than noise allows forgets.
#include "common/pixel_rays.h"
#include "ray_filter/ray_filter_io.h"
#include "ray_filter/surprise.glsl"

layout(local_size_x = 8, local_size_y = 8) in;  // a block
layout(push_constant, scalar) uniform Push { RayMeanPush p; } push;

layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2) uniform sampler2D sent;
layout(set = 0, binding = 3) uniform sampler2D previousMean;
layout(set = 0, binding = 4) uniform sampler2D previousSquare;
layout(set = 0, binding = 5) uniform sampler2D previousSurface;
layout(set = 0, binding = 6, scalar) uniform Cameras { ReprojectionCameras c; } cameras;
layout(set = 0, binding = 7, rgba32f) uniform writeonly image2D meanOf;   // a: frames it stands for
layout(set = 0, binding = 8, r32f) uniform writeonly image2D squareOf;    // second moment, mean of its channels
layout(set = 0, binding = 9, rgba16f) uniform writeonly image2D surface;  // normal; m along the axis, 0: none
layout(set = 0, binding = 10, rgba32f) uniform writeonly image2D rest;    // a: variance, mean of its channels
layout(set = 0, binding = 11) uniform sampler2D motionMap;  // m to where the surface was; read only if kMotion
layout(constant_id = 0) const bool kMotion = false;

void known(ivec2 size, vec3 normal, vec3 place, float depth, out vec4 mean, out float square) {
    mean = vec4(0.0), square = 0.0;
    ReprojectionCameras c = cameras.c;
    vec4 clip = c.previousClipFromWorld * vec4(place, 1.0);
    vec2 at = (clip.xy / max(clip.w, 1e-6) * 0.5 + 0.5) * vec2(size) - 0.5, low = floor(at);
    float footprint = 2.0 * c.pixelSize * max(depth, 1e-3), total = 0.0;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 tap = ivec2(low) + ivec2(i & 1, i >> 1), there = clamp(tap, ivec2(0), size - 1);
        vec4 s = texelFetch(previousSurface, there, 0);
        vec3 apart = placeOf(c.before, vec2(there), s.w) + c.before.eye - place;
        vec2 f = max(1.0 - abs(vec2(tap) - at), 0.0);
        float like = tap == there && s.w > 0.0 ? likeness(normal, apart, footprint, s.xyz) : 0.0;
        float weight = like > 0.25 ? f.x * f.y * like : 0.0;
        mean += weight * texelFetch(previousMean, there, 0);
        square += weight * texelFetch(previousSquare, there, 0).x;
        total += weight;
    }
    bool any = push.p.valid == 1 && depth > 0.0 && clip.w > 0.0 && total > 0.01;
    mean *= any ? 1.0 / total : 0.0;
    square *= any ? 1.0 / total : 0.0;
}

void main() {
    ivec2 size = imageSize(surface), pixel = ivec2(gl_GlobalInvocationID.xy), at = min(pixel, size - 1);
    float reversed = texelFetch(depthMap, at, 0).x, depth = reversed > 0.0 ? push.p.near / reversed : 0.0;
    vec3 normal = texelFetch(normalMap, at, 0).xyz, place = placeOf(cameras.c.now, vec2(at), depth) + cameras.c.now.eye;
    vec3 motion = kMotion ? texelFetch(motionMap, at, 0).xyz : vec3(0.0);
    vec4 mean;
    float square;
    known(size, normal, place + motion, depth, mean, square);
    vec3 e = texelFetch(sent, at, 0).rgb;
    float before = luminance(mean.rgb);
    bool counts = mean.a > 0.0 && depth > 0.0 && all(lessThan(pixel, size));
    float off = surprise(counts ? luminance(e) : 0.0, counts ? before : 0.0, counts ? max(square - meanProduct(mean.rgb, mean.rgb), 0.0) : 0.0);
    if (push.p.moving == 1) mean.a *= keptOf(off);
    float length_ = min(mean.a, push.p.mostLength - 1.0) + 1.0, share = 1.0 / length_;
    mean = vec4(mix(mean.rgb, e, share), length_);
    square = mix(square, meanProduct(e, e), share);
    bool seen = depth > 0.0;
    // A few samples know little of their spread: as if one more had been as far off as the mean is bright.
    float bright = meanProduct(mean.rgb, mean.rgb), variance = max(square - bright, 0.0) + bright / length_;
    if (any(greaterThanEqual(pixel, size))) return;
    imageStore(meanOf, pixel, seen ? mean : vec4(0.0));
    imageStore(squareOf, pixel, vec4(seen ? square : 0.0));
    imageStore(surface, pixel, vec4(normal, depth));
    imageStore(rest, pixel, seen ? vec4(mean.rgb, variance / length_) : vec4(0.0));
}
