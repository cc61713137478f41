#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// For each tile of the screen, which lights are near and which far.
#include "common/lanes.glsl"
#include "common/texels.glsl"
#include "gbuffer/gbuffer.glsl"
#include "val_shading/screen_tiles.glsl"

layout(push_constant, scalar) uniform Push { ValShadingPush p; } push;

layout(set = 0, binding = 0) uniform sampler2D depthMap;
layout(set = 0, binding = 1, scalar) uniform Camera { CameraConstants camera; } camera;
layout(set = 0, binding = 2) VEC4_TEXELS(vals);
layout(set = 0, binding = 3) VEC4_TEXELS(shapes);
layout(set = 0, binding = 4, scalar) writeonly buffer Lists { uint items[]; } lists;
layout(set = 0, binding = 5, scalar) writeonly buffer Counts { uvec2 items[]; } counts;

#include "val_shading/sort_lights.glsl"

Box boxOfTile(uint tile) {
    Box box = kEmptyBox;
    uvec2 origin = uvec2(tile % push.p.tiles.x, tile / push.p.tiles.x) * push.p.tileSize;
    uvec2 size = camera.camera.size;
    mat4 worldFromClip = camera.camera.worldFromClip;
    uint side = push.p.tileSize, pixels = side * side;
    for (uint i = laneIndex(); i < pixels; i += kLanes) {
        ivec2 pixel = ivec2(origin + uvec2(i % side, i / side));
        pixel = min(pixel, ivec2(size) - 1);
        float depth = texelFetch(depthMap, pixel, 0).x;
        vec3 x = worldFromPixel(worldFromClip, size, pixel, depth);
        if (depth > 0.0) extend(box, x);
    }
    return boxOfLanes(box);
}

void main() {
    uint tile = gl_WorkGroupID.x;
    uvec2 count = sortLights(tile, boxOfTile(tile), push.p.firstVal, push.p.valCount, push.p.nearReach);
    if (laneIndex() == 0) counts.items[tile] = count;
}
