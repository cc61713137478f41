#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Depth only: positions through the instance's transform into a shadow view.
#define AG_SCENE_INSTANCES
#define AG_SCENE_DRAWS
#include "scene/scene.glsl"

layout(push_constant, scalar) uniform Push { mat4 clipFromWorld; } push;
layout(location = 0) in vec3 position;

void main() {
    gl_Position = push.clipFromWorld * vec4(transformPoint(fetchInstance(drawnInstance()), position), 1.0);
}
