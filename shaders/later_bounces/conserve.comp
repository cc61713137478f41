#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// What falls on the points straight is added to what area lights send. All points together receive no more than was sent:
// shadow maps that let some light through a wall would hand it to both of its sides, and with walls on all sides every round
// of the loop of bounces would make more of it.
#include "common/pixel_rays.h"
#include "common/texels.glsl"
#include "later_bounces/later_bounces_io.h"

layout(local_size_x = kConserveLanes) in;  // one workgroup
layout(push_constant, scalar) uniform Push { GatherPush p; } push;
layout(constant_id = 6) const bool kSky = false;
layout(constant_id = 8) const bool kStraight = false;
layout(set = 0, binding = 0) VEC4_TEXELS(texels);
layout(set = 0, binding = 1) VEC4_TEXELS(vals);
layout(set = 0, binding = 2) VEC4_TEXELS(sky);
layout(set = 0, binding = 3) VEC4_TEXELS(straight);
layout(set = 0, binding = 4, scalar) buffer Irradiance { vec4 items[]; } irradiance;  // a: share that area lights and the sky sent

shared vec3 sentBy[kConserveLanes], arrivedAt[kConserveLanes];  // W

void main() {
    uint lane = gl_LocalInvocationID.x;
    vec3 sent = vec3(0.0), arrived = vec3(0.0);
    for (uint i = lane; i < push.p.valCount; i += kConserveLanes) sent += fetchTexel(vals, int(i) * 3 + 2).xyz;
    for (uint i = lane; i < push.p.count; i += kConserveLanes) {
        float area = fetchTexel(texels, int(i) * 3).w;
        vec3 straightOn = kSky ? fetchTexel(sky, int(i)).rgb : vec3(0.0), sentHere = irradiance.items[i].xyz + straightOn;
        if (kStraight) straightOn += fetchTexel(straight, int(i)).rgb;
        vec3 all = irradiance.items[i].xyz + straightOn;
        irradiance.items[i] = vec4(all, luminance(sentHere) / max(luminance(all), 1e-20));
        sent += area * straightOn;
        arrived += area * irradiance.items[i].xyz;
    }
    sentBy[lane] = sent, arrivedAt[lane] = arrived;
    for (uint half_ = kConserveLanes / 2; half_ > 0; half_ /= 2) {
        barrier();
        if (lane < half_) sentBy[lane] += sentBy[lane + half_], arrivedAt[lane] += arrivedAt[lane + half_];
    }
    barrier();
    vec3 share = min(sentBy[0] / max(arrivedAt[0], vec3(1e-20)), vec3(1.0));
    for (uint i = lane; i < push.p.count; i += kConserveLanes) irradiance.items[i].xyz *= share;
}
