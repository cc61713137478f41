// One pixel of each square of spacing x spacing. Before: DOWNSAMPLED_FORMAT.
layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { ivec2 place; int spacing; } push;
layout(set = 0, binding = 0) uniform sampler2D all;
layout(set = 0, binding = 1, DOWNSAMPLED_FORMAT) writeonly uniform image2D downsampled;

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy), last = textureSize(all, 0) - 1;
    if (any(greaterThanEqual(cell, imageSize(downsampled)))) return;
    imageStore(downsampled, cell, texelFetch(all, min(cell * push.spacing + push.place, last), 0));
}
