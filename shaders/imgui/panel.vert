#version 460
#extension GL_EXT_scalar_block_layout : require
layout(push_constant, scalar) uniform Push { vec2 scale, offset; } push;
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec4 color;
layout(location = 0) out vec2 outUv;
layout(location = 1) out vec4 outColor;

void main() {
    outUv = uv;
    outColor = color;
    gl_Position = vec4(position * push.scale + push.offset, 0.0, 1.0);
}
