#version 450
layout(push_constant) uniform Push { mat4 clipFromWorld; mat3x4 worldFromLocal; } push;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec3 outNormal;
void main() {
    vec3 world = vec4(position, 1.0) * push.worldFromLocal;
    outNormal = vec4(normal, 0.0) * push.worldFromLocal;  // rooms are not scaled unevenly
    gl_Position = push.clipFromWorld * vec4(world, 1.0);
}
