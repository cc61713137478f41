#version 450
layout(location = 0) in vec3 normal;
layout(location = 0) out vec4 outNormal;
void main() { outNormal = vec4(normalize(gl_FrontFacing ? normal : -normal), 0.0); }
