#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// A host's triangles as a light sees them.
#define AG_SCENE_INSTANCES
#include "guest/guest_io.h"
#include "scene/scene.glsl"

layout(push_constant, scalar) uniform Push { GuestRsmPush p; } push;

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;

layout(location = 0) out vec3 outNormal;
layout(location = 1) out vec2 outUv;

void main() {
    InstanceTransform t = fetchInstance(gl_InstanceIndex);
    outNormal = transformNormal(t, normal);
    outUv = uv;
    gl_Position = push.p.clipFromWorld * vec4(transformPoint(t, position), 1.0);
}
