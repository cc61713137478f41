#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Pixels that are like none of the four cells about them: of those farther away what is most alike. Where nothing is,
// the pixel is listed to be gathered by itself.
#include "common/listed_pixel.glsl"
#include "upsampling/cell_light.glsl"
#define PIXEL_LIST_BINDING 10
#include "common/pixel_list.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 5, scalar) readonly buffer Lacking { uint count; uint pixels[]; } lacking;
layout(set = 0, binding = 6, rgba16f) uniform writeonly image2D result;

const int kReach = 3;               // cells
const float kLeastLikeness = 1e-4;  // what is unlike still counts where nothing is alike
const float kAlone = 0.1;           // likeness of the most alike

void main() {
    if (gl_GlobalInvocationID.x >= lacking.count) return;
    ivec2 pixel = listedPixel(lacking.pixels[gl_GlobalInvocationID.x]);
    Surface s = surfaceAt(pixel);
    vec2 at = cellsAt(pixel);
    ivec2 nearest = ivec2(floor(at + 0.5));
    vec4 sum = vec4(0.0);
    float total = 0.0, most = 0.0;
    for (int i = 0; i < (2 * kReach + 1) * (2 * kReach + 1); ++i) {
        ivec2 cell = nearest + ivec2(i % (2 * kReach + 1), i / (2 * kReach + 1)) - kReach;
        vec2 apart = vec2(cell) - at;
        float like = likenessOf(s, cell), weight = (like + kLeastLikeness) / (1.0 + dot(apart, apart));
        most = max(most, like);
        sum += weight * lightFor(s, cell);
        total += weight;
    }
    imageStore(result, pixel, withBase(pixel, sum / total));
    if (most < kAlone) listPixel(pixel);
}
