#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Irradiance at the points from the area lights of one of their run's lists, through the shadow maps the screen is lit
// through.
#include "common/texels.glsl"
layout(constant_id = 0) const uint kShape = 4;
layout(constant_id = 1) const int kVisibilityTaps = 0;
layout(constant_id = 2) const uint kList = 0;
layout(constant_id = 5) const bool kAdd = false;  // to what the other list's light made

layout(set = 0, binding = 3) VEC4_TEXELS(vals);
layout(set = 0, binding = 4) VEC4_TEXELS(shapes);
layout(set = 0, binding = 5) VEC4_TEXELS(isms);
#include "later_bounces/later_bounces_io.h"
#include "val_shading/area_light.glsl"
#include "val_shading/light_lists.glsl"

const int kPoints = 4;  // an invocation: a light in registers shines on all of them
layout(local_size_x = kRunPoints / kPoints) in;

layout(push_constant, scalar) uniform Push { GatherPush p; } push;
layout(set = 0, binding = 0) VEC4_TEXELS(texels);
layout(set = 0, binding = 1) UINT_TEXELS(lists);
layout(set = 0, binding = 2, scalar) readonly buffer Counts { uvec2 items[]; } counts;
layout(set = 0, binding = 6, scalar) buffer Irradiance { vec4 items[]; } irradiance;

struct Points {
    vec3 x[kPoints], n[kPoints], e[kPoints];
};

void addLight(AreaLight l, inout Points points) {
    [[unroll]] for (int p = 0; p < kPoints; ++p)
        points.e[p] += irradianceFrom(l, points.x[p], points.n[p], 0.0, push.p.ismTileSize);
}

void main() {
    uint run_ = gl_WorkGroupID.x, first = gl_GlobalInvocationID.x * kPoints;
    Points points;
    [[unroll]] for (int p = 0; p < kPoints; ++p) {
        int at = int(min(first + p, push.p.count - 1)) * 3;
        points.x[p] = fetchTexel(texels, at).xyz, points.n[p] = fetchTexel(texels, at + 1).xyz, points.e[p] = vec3(0.0);
    }
    uint start = listStart(run_, kList, push.p.valCount), count = counts.items[run_][kList];
    AG_MEET_LIGHTS(start, count, addLight(l, points))
    [[unroll]] for (int p = 0; p < kPoints; ++p) {
        uint at = first + p;
        if (at >= push.p.count) continue;
        vec3 before = kAdd ? irradiance.items[at].xyz : vec3(0.0);
        irradiance.items[at] = vec4(before + points.e[p], 1.0);
    }
}
