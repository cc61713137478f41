#version 460
// Light of the gathered pixels to those pixels alone.
layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { ivec2 place; int spacing; } push;  // of the pixel in its square
layout(set = 0, binding = 0) uniform sampler2D light;
layout(set = 0, binding = 1, rgba16f) uniform writeonly image2D result;

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy), pixel = cell * push.spacing + push.place;
    if (any(greaterThanEqual(cell, textureSize(light, 0))) || any(greaterThanEqual(pixel, imageSize(result)))) return;
    imageStore(result, pixel, texelFetch(light, cell, 0));
}
