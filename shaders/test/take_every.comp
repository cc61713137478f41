#version 460
// Every step-th pixel, as techniques that leave pixels out gather them.
layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { int step; } push;
layout(set = 0, binding = 0) uniform sampler2D source;
layout(set = 0, binding = 1, rgba16f) writeonly uniform image2D result;

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, imageSize(result)))) return;
    imageStore(result, p, texelFetch(source, p * push.step + push.step / 2, 0));
}
