#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// A texel of a reflective shadow map: normal and albedo of the host's surface. A single-sided one blocks light from both
// sides and reflects it from its front alone.
#include "guest/guest_io.h"
#include "scene/scene.glsl"

layout(push_constant, scalar) uniform Push { GuestRsmPush p; } push;
layout(set = 1, binding = 0) uniform sampler2D albedoMap;

layout(location = 0) in vec3 normal;
layout(location = 1) in vec2 uv;

layout(location = 0) out vec4 outNormal;
layout(location = 1) out vec4 outAlbedo;

void main() {
    vec4 texel = texture(albedoMap, uv);
    if (push.p.mapped == 0) texel = vec4(1.0);
    if (texel.a < push.p.alphaCutoff) discard;
    bool reflects = gl_FrontFacing || push.p.doubleSided != 0;
    vec3 n = unitNormal(normal);
    outNormal = vec4(gl_FrontFacing ? n : -n, 1.0);
    outAlbedo = vec4(reflects ? push.p.albedo * texel.rgb : vec3(0.0), 0.0);
}
