#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// What moved, where gbuffer/fill.vert put it, and the way back to where it was a frame ago.
#define AG_SCENE_INSTANCES
#include "scene/scene.glsl"

layout(set = 0, binding = 1) uniform samplerBuffer previousInstances;
layout(push_constant, scalar) uniform Push { mat4 clipFromWorld; } push;

layout(location = 0) in vec3 position;
invariant gl_Position;
layout(location = 0) out vec3 outMotion;  // m

void main() {
    InstanceTransform t = fetchInstance(gl_InstanceIndex);
    vec3 now = transformPoint(t, position);
    vec4 p = vec4(position, 1.0);
    vec3 before = vec3(dot(texelFetch(previousInstances, gl_InstanceIndex * 4 + 0), p),
                       dot(texelFetch(previousInstances, gl_InstanceIndex * 4 + 1), p),
                       dot(texelFetch(previousInstances, gl_InstanceIndex * 4 + 2), p));
    outMotion = before - now;
    gl_Position = push.clipFromWorld * vec4(now, 1.0);
}
