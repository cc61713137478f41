#version 460
#extension GL_EXT_scalar_block_layout : require
layout(push_constant, scalar) uniform Push { mat4 clipFromMesh; vec3 albedo; } push;
layout(location = 0) in vec3 normal;
layout(location = 1) in float darkness;
layout(location = 0) out vec4 outNormal;
layout(location = 1) out vec4 outAlbedo;

void main() {
    outNormal = vec4(normalize(normal) * (gl_FrontFacing ? 1.0 : -1.0), 1.0);
    outAlbedo = vec4(push.albedo * (gl_FrontFacing ? 1.0 - darkness : 0.0), 1.0);
}
