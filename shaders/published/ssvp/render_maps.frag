#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// What a cluster sees: position, normal, albedo.
#define AG_SCENE_MATERIALS
#include "scene/scene.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) flat in uint material;
layout(location = 4) in vec3 fromCluster;
layout(location = 5) in vec3 color;

layout(location = 0) out vec4 outPosition;  // alpha 1: something is there
layout(location = 1) out vec4 outNormal;
layout(location = 2) out vec4 outAlbedo;

const float kLeastElevation = 0.01;  // sine over the cluster's own plane

void main() {
    if (fromCluster.z < kLeastElevation * length(fromCluster)) discard;
    SurfaceMaterial m = tintedMaterial(material, uv, color);
    vec3 n = normalize(normal);
    outPosition = vec4(position, 1.0);
    outNormal = vec4(gl_FrontFacing ? n : -n, 1.0);
    outAlbedo = vec4(bounceAlbedo(material, m, false), 1.0);
}
