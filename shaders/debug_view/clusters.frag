#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Clusters as Voronoi colours over the scene: each lit surface point in the colour of the cluster its texel is in.
#include "common/false_color.h"
#include "common/texels.glsl"
#include "debug_view/lit_surface.glsl"
#include "gbuffer/gbuffer.glsl"
#include "val_clustering/val_clustering_io.h"

layout(push_constant, scalar) uniform Push { RsmAtlas atlas; } push;
layout(set = 0, binding = 2) UINT_TEXELS(slotOfTexel);
layout(set = 0, binding = 3) UINT_TEXELS(candidates);
layout(set = 0, binding = 4) uniform sampler2D depthMap;
layout(set = 0, binding = 5) uniform sampler2D normalMap;
layout(set = 0, binding = 6, scalar) uniform Camera { CameraConstants camera; } camera;

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depthMap, pixel, 0).x;
    vec3 position = worldFromPixel(camera.camera.worldFromClip, camera.camera.size, pixel, depth);
    vec3 toEye = normalize(camera.camera.position - position);
    float shade = depth > 0.0 ? 0.25 + 0.75 * max(dot(texelFetch(normalMap, pixel, 0).xyz, toEye), 0.0) : 0.0;
    uint texel = findTexel(position, push.atlas.faceCount, push.atlas.size);
    uint slot = texel == 0xffffffffu ? kNoCluster : fetchTexel(slotOfTexel, int(texel)).x;
    vec3 base = vec3(0.15);
    if (slot != kNoCluster) {
        uint tile = texel / (kRsmTileSize * kRsmTileSize);
        base = hueFromIndex(fetchTexel(candidates, int(tile * kMaxCandidates + slot)).x);
    }
    color = vec4(base * shade, 1.0);
}
