#version 460
#extension GL_EXT_scalar_block_layout : require
// A level mixed with the coarser one, drawn out to its size by a tent of 3 x 3 pixels.
layout(set = 0, binding = 0) uniform sampler2D fine;
layout(set = 0, binding = 1) uniform sampler2D coarse;
layout(push_constant, scalar) uniform Push { float share; } push;  // of the coarser one
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 mixed;

void main() {
    vec2 pixel = 1.0 / vec2(textureSize(coarse, 0));
    vec4 spread = vec4(0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            spread += float((2 - abs(x)) * (2 - abs(y))) / 16.0 * textureLod(coarse, uv + vec2(x, y) * pixel, 0.0);
    vec4 here = textureLod(fine, uv, 0.0);
    mixed = vec4(mix(here.rgb, spread.rgb, push.share), here.a);
}
