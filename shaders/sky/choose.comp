#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// How likely a pixel of a block of the screen is to draw each cell of the sky: by its power, by how it falls on some of the
// block's pixels, and by how often it was seen from the block. One group of lanes a block.
#include "common/lanes.glsl"
#include "common/texels.glsl"
#include "gbuffer/gbuffer.glsl"
#include "sky/blocks.glsl"

layout(push_constant, scalar) uniform Push { SkyChoosePush p; } push;
layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2, scalar) readonly buffer Cells { float items[]; } cells;  // power, W/m²
layout(set = 0, binding = 3, scalar) readonly buffer Seen { vec2 items[]; } seen;     // how often, of how many rays
layout(set = 0, binding = 4, scalar) buffer UpTo { float items[]; } upTo;   // how likely a cell or one before is

const uint kPlaces = 8;
const float kEvenly = 0.1;       // of draws, wherever light was found: pixels may differ
const float kCellRadius = 0.15;  // sine of the angle within a cell
shared vec4 normals[kPlaces];    // w: 0: no surface

// One for each 2 x 4 pixels that has any: a block may see little but sky.
void findNormals(uvec2 origin) {
    const uint kMiddle = 5;
    ivec2 size = textureSize(depthMap, 0);
    for (uint i = laneIndex(); i < kPlaces; i += kLanes) {
        uvec2 corner = origin + uvec2(i & 3u, i >> 2) * uvec2(2, 4);
        normals[i] = vec4(0.0);
        for (uint k = 0; k < 8 && normals[i].w == 0.0; ++k) {
            uint at = (kMiddle + k) % 8;
            ivec2 pixel = min(ivec2(corner + uvec2(at & 1u, at >> 1)), size - 1);
            if (texelFetch(depthMap, pixel, 0).x > 0.0) normals[i] = vec4(texelFetch(normalMap, pixel, 0).xyz, 1.0);
        }
    }
    laneBarrier();
}

float falls(vec3 direction) {
    float sum = 0.0;
    for (uint i = 0; i < kPlaces; ++i) sum += normals[i].w * clamp(dot(normals[i].xyz, direction) + kCellRadius, 0.0, 1.0);
    return sum;
}

void main() {
    uint block = gl_WorkGroupID.x, first = block * kSkyCells;
    findNormals(skyBlockOrigin(block, uvec2(textureSize(depthMap, 0))));
    float total = 0.0, even = 0.0;
    for (uint base = 0; base < kSkyCells; base += kLanes) {
        uint cell = base + laneIndex();
        vec2 found = push.p.known == 1 ? seen.items[first + cell] : vec2(0.0);
        float fallsHere = cells.items[cell] * falls(skyDirectionAt(skyPlaceOf(cell, 0, vec2(0.5 * float(kSkyCell)))));
        float weight = fallsHere * (found.x + 0.5) / (found.y + 1.0);
        upTo.items[first + cell] = weight;
        total += laneAdd(weight);
        even += laneAdd(fallsHere);
    }
    float before = 0.0, share = total > 1e-20 ? (1.0 - kEvenly) / total : 0.0, evenly = even > 1e-20 ? kEvenly / even : 0.0;
    for (uint base = 0; base < kSkyCells; base += kLanes) {
        uint cell = base + laneIndex();
        float fallsHere = cells.items[cell] * falls(skyDirectionAt(skyPlaceOf(cell, 0, vec2(0.5 * float(kSkyCell)))));
        float chance = upTo.items[first + cell] * share + fallsHere * evenly;
        float end = before + laneInclusiveAdd(chance);
        before += laneAdd(chance);
        upTo.items[first + cell] = end;
    }
}
