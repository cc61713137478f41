#version 460
// Half the size: 13 linear taps that weigh 6 x 6 pixels smoothly (Jimenez 2014), so that small bright things do not flicker.
// The weights sum to 1.
layout(set = 0, binding = 0) uniform sampler2D light;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 halved;

vec4 tap(vec2 pixels) { return textureLod(light, uv + pixels / vec2(textureSize(light, 0)), 0.0); }

void main() {
    vec4 inner = tap(vec2(-1, -1)) + tap(vec2(1, -1)) + tap(vec2(-1, 1)) + tap(vec2(1, 1));
    vec4 corners = tap(vec2(-2, -2)) + tap(vec2(2, -2)) + tap(vec2(-2, 2)) + tap(vec2(2, 2));
    vec4 sides = tap(vec2(0, -2)) + tap(vec2(-2, 0)) + tap(vec2(2, 0)) + tap(vec2(0, 2));
    halved = 0.125 * (inner + tap(vec2(0.0))) + 0.0625 * sides + 0.03125 * corners;
}
