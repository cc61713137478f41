#version 460
#extension GL_EXT_scalar_block_layout : require
// A host's own way to draw a mesh that stands at one place.
layout(push_constant, scalar) uniform Push { mat4 clipFromMesh; vec3 albedo; } push;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 darkness;  // painted on the vertices
layout(location = 0) out vec3 outNormal;
layout(location = 1) out float outDarkness;

void main() {
    outNormal = normal;
    outDarkness = darkness.x;
    gl_Position = push.clipFromMesh * vec4(position, 1.0);
}
