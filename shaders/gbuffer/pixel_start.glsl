// Where a pixel's rays begin. Before: `camera`; push.p.offset and push.p.pixelOffset (m, and in pixels: so far before surfaces).
#ifndef AG_PIXEL_START_GLSL
#define AG_PIXEL_START_GLSL

#include "gbuffer/gbuffer.glsl"

struct PixelStart {
    vec3 place;    // m
    float offset;  // m: rays leave so far before it
};

PixelStart startOf(ivec2 pixel, float depth) {
    uvec2 size = camera.camera.size;
    mat4 worldFromClip = camera.camera.worldFromClip;
    vec3 place = worldFromPixel(worldFromClip, size, pixel, depth);
    float wide = distance(place, worldFromPixel(worldFromClip, size, pixel + ivec2(1, 0), depth));
    float offset = max(push.p.offset, push.p.pixelOffset * wide);
    // Nearer to the camera, which sees it: in a crease rounding may put it behind the other surface.
    return PixelStart(place + normalize(camera.camera.position - place) * offset, offset);
}
#endif
