#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
// This frame's rays and their control into the means that the frames before left on the same surface, and into their second
// moments. Of the control by how much it differs from the area lights' sum, which is its expectation: that sum changes from
// frame to frame while clusters settle. While things move, a block whose rays find more or less than noise allows forgets,
// and so does a pixel whose area lights send more or less.
#include "common/pixel_rays.h"
#include "ray_filter/surprise.glsl"
#include "texel_rays/carried.glsl"
#include "texel_rays/texel_rays_io.h"

layout(local_size_x = 8, local_size_y = 8) in;  // a block
layout(push_constant, scalar) uniform Push { RayAccumulatePush p; } push;

layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2) uniform sampler2D areaLights;
layout(set = 0, binding = 3) uniform sampler2D sent;
layout(set = 0, binding = 4) uniform sampler2D control;
layout(set = 0, binding = 5) uniform sampler2D previousSent;
layout(set = 0, binding = 6) uniform sampler2D previousControl;
layout(set = 0, binding = 7) uniform sampler2D previousMoments;
layout(set = 0, binding = 8) uniform sampler2D previousSurface;
layout(set = 0, binding = 9, scalar) uniform Cameras { ReprojectionCameras c; } cameras;
layout(set = 0, binding = 10, rgba32f) uniform writeonly image2D sentMean;     // rgb: W/m²; a: frames it stands for
// rgb: less the area lights' sum, W/m²; a: luminance of that.
layout(set = 0, binding = 11, rgba32f) uniform writeonly image2D controlMean;
layout(set = 0, binding = 12, rgba32f) uniform writeonly image2D moments;      // second ones: of rays; both; of control
layout(set = 0, binding = 13, rgba16f) uniform writeonly image2D surface;      // normal; m along the axis, 0: sky
layout(set = 0, binding = 14) uniform sampler2D sentNear;
layout(set = 0, binding = 15) uniform sampler2D motionMap;  // m to where the surface was; read only if kMotion
layout(constant_id = 0) const bool kMotion = false;
#include "ray_filter/before.glsl"

const float kMostTimes = 64.0;  // a draw may send so many times what is known: more came of a tiny probability

struct Means {
    vec4 sent, control, moments;
};

Means known(ivec2 size, vec3 normal, vec3 place, float depth) {
    Means m = Means(vec4(0.0), vec4(0.0), vec4(0.0));
    if (push.p.valid == 0) return m;
    Before b = seenBefore(size, normal, place, depth);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        m.sent += b.weights[i] * texelFetch(previousSent, b.taps[i], 0);
        m.control += b.weights[i] * texelFetch(previousControl, b.taps[i], 0);
        m.moments += b.weights[i] * texelFetch(previousMoments, b.taps[i], 0);
    }
    return m;
}

void main() {
    ivec2 size = imageSize(surface), pixel = ivec2(gl_GlobalInvocationID.xy), at = min(pixel, size - 1);
    float reversed = texelFetch(depthMap, at, 0).x, depth = reversed > 0.0 ? push.p.near / reversed : 0.0;
    vec3 normal = texelFetch(normalMap, at, 0).xyz, place = placeOf(cameras.c.now, vec2(at), depth) + cameras.c.now.eye;
    vec3 motion = kMotion ? texelFetch(motionMap, at, 0).xyz : vec3(0.0);
    Means m = known(size, normal, place + motion, depth);
    vec3 lights = texelFetch(areaLights, at, 0).rgb, p = texelFetch(sent, at, 0).rgb, q = texelFetch(control, at, 0).rgb;
    float e = luminance(lights), most = kMostTimes * max(e, luminance(m.sent.rgb)), bright = max(luminance(p), luminance(q));
    float kept = bright > most && most > 0.0 ? most / bright : 1.0;
    p *= kept, q *= kept;
    p += texelFetch(sentNear, at, 0).rgb;  // at most what surfaces send: needs no limit
    bool inside = all(lessThan(pixel, size)), counts = m.sent.a > 0.0 && depth > 0.0 && inside;
    float before = luminance(m.sent.rgb), spread = max(m.moments.x - meanProduct(m.sent.rgb, m.sent.rgb), 0.0);
    float off = surprise(counts ? luminance(p) : 0.0, counts ? before : 0.0, counts ? spread : 0.0);
    if (push.p.moving == 1) m.sent.a *= keptOf(off) * stillTrue(e, m.control.a);
    m.sent.a = min(m.sent.a, push.p.mostLength - 1.0) + 1.0;
    float share = 1.0 / m.sent.a;
    m.sent.rgb = mix(m.sent.rgb, p, share);
    m.control = mix(m.control, vec4(q - lights, e), share);
    m.moments.xyz = mix(m.moments.xyz, vec3(meanProduct(p, p), meanProduct(p, q), meanProduct(q, q)), share);
    bool seen = depth > 0.0;
    if (!inside) return;
    imageStore(sentMean, pixel, seen ? m.sent : vec4(0.0));
    imageStore(controlMean, pixel, seen ? m.control : vec4(0.0));
    imageStore(moments, pixel, seen ? m.moments : vec4(0.0));
    imageStore(surface, pixel, vec4(normal, depth));
}
