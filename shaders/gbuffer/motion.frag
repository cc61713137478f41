#version 460
// The way back to where the surface was a frame ago.
layout(location = 0) in vec3 motion;
layout(location = 0) out vec4 outMotion;

void main() { outMotion = vec4(motion, 1.0); }
