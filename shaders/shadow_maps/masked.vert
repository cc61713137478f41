#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Depth of alpha-masked surfaces: needs their texture coordinates.
#define AG_SCENE_INSTANCES
#define AG_SCENE_DRAWS
#include "scene/scene.glsl"

layout(push_constant, scalar) uniform Push { mat4 clipFromWorld; } push;
layout(location = 0) in vec3 position;
layout(location = 3) in vec2 uv;

layout(location = 0) out vec2 outUv;
layout(location = 1) flat out uint outMaterial;

void main() {
    InstanceTransform t = fetchInstance(drawnInstance());
    outUv = uv;
    outMaterial = t.material;
    gl_Position = push.clipFromWorld * vec4(transformPoint(t, position), 1.0);
}
