#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// One instance's triangles to clip space; the camera, a shadow view or an RSM face by push constant.
#define AG_SCENE_INSTANCES
#define AG_SCENE_DRAWS
#include "scene/scene.glsl"

layout(push_constant, scalar) uniform Push { mat4 clipFromWorld; } push;

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec4 color;

invariant gl_Position;  // what moved is drawn again at equal depth
layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec4 outTangent;
layout(location = 3) out vec2 outUv;
layout(location = 4) flat out uint outMaterial;
layout(location = 5) out vec3 outColor;

void main() {
    InstanceTransform t = fetchInstance(drawnInstance());
    outPosition = transformPoint(t, position);
    outNormal = transformNormal(t, normal);
    outTangent = vec4(transformDirection(t, tangent.xyz), tangent.w * handednessOf(t));
    outUv = uv;
    outMaterial = t.material;
    outColor = color.rgb;
    gl_Position = push.clipFromWorld * vec4(outPosition, 1.0);
}
