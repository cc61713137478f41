// Leaves a pixel to a later pass of 64 invocations a workgroup. Before: PIXEL_LIST_BINDING, the first of two.
layout(set = 0, binding = PIXEL_LIST_BINDING, scalar) buffer Pixels { uint count; uint pixels[]; } listed;
layout(set = 0, binding = PIXEL_LIST_BINDING + 1, scalar) buffer Groups { uvec3 count; } listedGroups;

const uint kMostListGroups = 65535;  // that every device dispatches: four million pixels

// The order of the list varies, so the picture must not depend on it.
void listPixel(ivec2 pixel) {
    uint at = atomicAdd(listed.count, 1);
    listed.pixels[at] = uint(pixel.x) | uint(pixel.y) << 16;
    atomicMax(listedGroups.count.x, min(at / 64 + 1, kMostListGroups));
}
