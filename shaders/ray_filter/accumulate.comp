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
#include "ray_filter/before.glsl"

struct Mean {
    vec4 light;
    float square;
};

Mean known(ivec2 size, vec3 normal, vec3 place, float depth) {
    Mean m = Mean(vec4(0.0), 0.0);
    if (push.p.valid == 0) return m;
    Before b = seenBefore(size, normal, place, depth);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        m.light += b.weights[i] * texelFetch(previousMean, b.taps[i], 0);
        m.square += b.weights[i] * texelFetch(previousSquare, b.taps[i], 0).x;
    }
    return m;
}

void main() {
    ivec2 size = imageSize(surface), pixel = ivec2(gl_GlobalInvocationID.xy), at = min(pixel, size - 1);
    float reversed = texelFetch(depthMap, at, 0).x, depth = reversed > 0.0 ? push.p.near / reversed : 0.0;
    vec3 normal = texelFetch(normalMap, at, 0).xyz, place = placeOf(cameras.c.now, vec2(at), depth) + cameras.c.now.eye;
    vec3 motion = kMotion ? texelFetch(motionMap, at, 0).xyz : vec3(0.0);
    Mean m = known(size, normal, place + motion, depth);
    vec4 mean = m.light;
    float square = m.square;
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
