#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Irradiance from near lights, all of them at every pixel, and the far ones' from the n x n pixels that hold a part each
// (Laine et al. 2007): only from those on the same surface and in the same tile, whose parts fit together.
layout(constant_id = 0) const uint kShape = 4;
layout(constant_id = 2) const int kSide = 1;
#include "published/interleaved_shading/shared_maps.glsl"
#include "published/interleaved_shading/lacking.h"
#include "val_shading/gather_inputs.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 8) uniform sampler2D parts;
layout(set = 0, binding = 9, rgba16f) uniform writeonly image2D irradiance;
layout(set = 0, binding = 10, scalar) buffer LackingCounts { uint items[]; } lackingCounts;
layout(set = 0, binding = 11, scalar) writeonly buffer Lacking { uint items[]; } lacking;

// For gather_lacking.comp. In any order: each pixel is on its own there, so none may be noted twice.
void noteLacking(TileBlock block, int p, uint parts) {
    bool onScreen = all(lessThan(pixelOf(block, p), ivec2(camera.camera.size)));
    if (parts == 0u || block.spare || !onScreen) return;
    uvec2 inTile = block.inTile + uvec2(p & 1, p >> 1);
    uint first = block.tile * push.p.tileSize * push.p.tileSize;
    lacking.items[first + atomicAdd(lackingCounts.items[block.tile], 1u)] =
        packLacking(inTile.y * push.p.tileSize + inTile.x, parts);
}

const float kMostPlaneShare = 0.0015;  // of the depth, from the plane: surfaces at an angle part within a pixel or two

struct Surface {
    vec3 position, normal;
    float depth;
    float width;  // m, of the pixel
    vec2 slope;  // of depth over pixels: near / distance is linear in the image along a plane
};

Surface surfaceAt(ivec2 pixel) {
    Surface s;
    mat4 worldFromClip = camera.camera.worldFromClip;
    uvec2 size = camera.camera.size;
    vec3 eye = camera.camera.position;
    s.depth = texelFetch(depthMap, pixel, 0).x;
    s.normal = texelFetch(normalMap, pixel, 0).xyz;
    s.position = worldFromPixel(worldFromClip, size, pixel, max(s.depth, 1e-9));
    float height = dot(s.normal, s.position - eye);
    vec3 across = worldFromPixel(worldFromClip, size, pixel + ivec2(1, 0), 1.0) - eye;
    vec3 down = worldFromPixel(worldFromClip, size, pixel + ivec2(0, 1), 1.0) - eye;
    s.slope = vec2(dot(s.normal, across), dot(s.normal, down)) / min(height, -1e-9) - s.depth;
    s.width = widthOf(pixel, s.depth);
    return s;
}

struct Pixel {  // of the window about a block
    float depth;  // 0: sky or outside the tile
    vec3 part;
};

struct TileBounds {
    ivec2 first, end;
};

Pixel fetchPixel(TileBounds bounds, ivec2 at) {
    bool inside = all(greaterThanEqual(at, bounds.first)) && all(lessThan(at, bounds.end));
    at = clamp(at, bounds.first, bounds.end - 1);
    vec4 part = texelFetch(parts, at, 0);  // and the distance
    return Pixel(inside && part.w > 0.0 ? camera.camera.near / part.w : 0.0, part.rgb);
}

// Of a pixel so far aside: its part and 1, or nothing where it is on another surface.
vec4 partOf(Pixel pixel, Surface s, ivec2 aside) {
    float expected = s.depth + dot(s.slope, vec2(aside));
    bool same = pixel.depth > 0.0 && abs(pixel.depth - expected) <= kMostPlaneShare * s.depth;
    return same ? vec4(pixel.part, 1.0) : vec4(0.0);
}

uint partIdOf(TileBounds bounds, ivec2 pixel) {
    ivec2 inBlock = (pixel - bounds.first) % kSide;
    return uint(inBlock.y * kSide + inBlock.x);
}

// The parts of each of a block's pixels, from the nearest that hold them, out of a window the block shares. Returns those
// that are on other surfaces there.
void addFarIrradiance(TileBounds bounds, ivec2 corner, Surface s[kPixels], inout Receiver r[kPixels], out uint lackingParts[kPixels]) {
    const int kWindow = kSide + 1;
    // Moved into the tile where it would stand out: it holds each part all the same.
    ivec2 first = clamp(corner - kSide / 2, bounds.first, max(bounds.end - kWindow, bounds.first));
    Pixel window[kWindow * kWindow];
    [[unroll]] for (int i = 0; i < kWindow * kWindow; ++i)
        window[i] = fetchPixel(bounds, first + ivec2(i % kWindow, i / kWindow));
    [[unroll]] for (int p = 0; p < kPixels; ++p) {
        ivec2 place = ivec2(p & 1, p >> 1);
        vec4 sum = vec4(0.0);
        lackingParts[p] = 0;
        [[unroll]] for (int i = 0; i < kSide * kSide; ++i) {
            ivec2 at = ivec2(i % kSide, i / kSide) + place;
            vec4 part = partOf(window[at.y * kWindow + at.x], s[p], first - corner - place + at);
            sum += part;
            lackingParts[p] |= part.w == 0.0 && s[p].depth > 0.0 ? 1u << partIdOf(bounds, first + at) : 0u;
        }
        r[p].irradiance += sum.rgb;
    }
}

void addLightToAll(AreaLight l, inout Receiver r[kPixels]) {
    [[unroll]] for (int p = 0; p < kPixels; ++p) addLight(l, push.p.ismTileSize, r[p]);
}

void main() {
    TileBlock block = tileBlock(gl_GlobalInvocationID.x, push.p.tileSize, push.p.tiles);
    ivec2 size = ivec2(camera.camera.size);
    TileBounds bounds = TileBounds(ivec2(block.origin), min(ivec2(block.origin + push.p.tileSize), size));
    Surface s[kPixels];
    Receiver r[kPixels];
    [[unroll]] for (int p = 0; p < kPixels; ++p) {
        ivec2 pixel = min(pixelOf(block, p), size - 1);
        s[p] = surfaceAt(pixel);
        r[p] = Receiver(s[p].position, s[p].normal, s[p].width, vec3(0.0), vec3(0.0));
    }
    uint lackingParts[kPixels];
    addFarIrradiance(bounds, pixelOf(block, 0), s, r, lackingParts);
    for (int p = 0; p < kPixels; ++p) noteLacking(block, p, lackingParts[p]);
    uint start = listStart(block.tile, kNearList, push.p.valCount), count = counts.items[block.tile].x;
    AG_MEET_LIGHTS(start, count, addLightToAll(l, r))
    [[unroll]] for (int p = 0; p < kPixels; ++p) {
        ivec2 pixel = pixelOf(block, p);
        if (any(greaterThanEqual(pixel, size))) continue;
        bool seen = s[p].depth > 0.0;
        imageStore(irradiance, pixel, vec4(seen ? min(r[p].irradiance, vec3(kMostHalf)) : vec3(0.0), 1.0));
    }
}
