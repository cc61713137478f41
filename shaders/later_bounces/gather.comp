#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Irradiance at the points, from the area lights the screen is lit by and through their shadow maps.
layout(constant_id = 0) const uint kShape = 4;
layout(constant_id = 1) const int kVisibilityTaps = 0;

layout(set = 0, binding = 3) uniform samplerBuffer vals;
layout(set = 0, binding = 4) uniform samplerBuffer shapes;
layout(set = 0, binding = 5) uniform samplerBuffer isms;
#include "later_bounces/later_bounces_io.h"
#include "rsm/rsm_io.h"
#include "val_shading/area_light.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { GatherPush p; } push;
layout(set = 0, binding = 0) uniform samplerBuffer texels;
layout(set = 0, binding = 1, scalar) writeonly buffer Irradiance { vec4 items[]; } irradiance;

void main() {
    uint i = gl_GlobalInvocationID.x;
    int at = int(min(i, push.p.count - 1)) * 3;
    vec3 x = texelFetch(texels, at).xyz, n = texelFetch(texels, at + 1).xyz, e = vec3(0.0);
    if (kLaneParallel) {
        for (uint base = 0; base < push.p.valCount; base += kSubgroupSize) {
            AreaLight mine = loadLight(min(base + gl_SubgroupInvocationID, push.p.valCount - 1));
            uint here = min(kSubgroupSize, push.p.valCount - base);
            [[dont_unroll]] for (uint lane = 0; lane < here; ++lane)
                e += irradianceFrom(lightOfLane(mine, lane), x, n, 0.0, push.p.ismTileSize);
        }
    } else {
        for (uint l = 0; l < push.p.valCount; ++l) e += irradianceFrom(loadLight(l), x, n, 0.0, push.p.ismTileSize);
    }
    if (i < push.p.count) irradiance.items[i] = vec4(e, 1.0);
}
