#version 460
layout(push_constant) uniform Push { float value; } push;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;

void main() { color = vec4(push.value, uv, 1.0); }
