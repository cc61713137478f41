#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
// What the frame before knew of each pixel's surface: of the four pixels about where it was those on the same surface, else
// of the nine about, else nothing. Writes the surfaces for the frame to come.
#include "denoiser/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2) uniform sampler2D previousLight;
layout(set = 0, binding = 3) uniform sampler2D previousSurface;
layout(set = 0, binding = 4, scalar) uniform Cameras { ReprojectionCameras c; } cameras;
layout(set = 0, binding = 5, rgba16f) uniform writeonly image2D surface;
layout(set = 0, binding = 6, rgba16f) uniform writeonly image2D history;  // a: frames it stands for, 0: none
layout(set = 0, binding = 7) uniform sampler2D motionMap;  // m to where the surface was; read only if kMotion
layout(constant_id = 0) const bool kMotion = false;
const float kMostMovedLength = 4.0;  // frames: what moves comes into other light
layout(push_constant, scalar) uniform Push { ReprojectPush p; } push;

void main() {
    ivec2 size = imageSize(surface), pixel = min(ivec2(gl_GlobalInvocationID.xy), size - 1);
    ReprojectionCameras c = cameras.c;
    float reversed = texelFetch(depthMap, pixel, 0).x, depth = reversed > 0.0 ? push.p.near / reversed : 0.0;
    vec3 normal = texelFetch(normalMap, pixel, 0).xyz;
    vec3 place = placeOf(c.now, vec2(pixel), depth) + c.now.eye;
    vec4 motion = kMotion ? texelFetch(motionMap, pixel, 0) : vec4(0.0);
    place += motion.xyz;
    vec4 clip = c.previousClipFromWorld * vec4(place, 1.0);
    vec2 at = (clip.xy / max(clip.w, 1e-6) * 0.5 + 0.5) * vec2(size) - 0.5, nearest = floor(at + 0.5);
    float footprint = 2.0 * c.pixelSize * max(depth, 1e-3);
    bool known = push.p.valid == 1 && depth > 0.0 && clip.w > 0.0;
    vec4 close = vec4(0.0), wide = vec4(0.0);
    float closeWeight = 0.0, wideWeight = 0.0;
    [[unroll]] for (int y = -1; y <= 1; ++y)
        [[unroll]] for (int x = -1; x <= 1; ++x) {
            ivec2 tap = ivec2(nearest) + ivec2(x, y);
            bool inside = all(greaterThanEqual(tap, ivec2(0))) && all(lessThan(tap, size));
            ivec2 there = clamp(tap, ivec2(0), size - 1);
            vec4 s = texelFetch(previousSurface, there, 0), light = texelFetch(previousLight, there, 0);
            vec3 apart = placeOf(c.before, vec2(there), s.w) + c.before.eye - place;
            float like = inside && s.w > 0.0 && light.a > 0.0 ? likeness(normal, apart, footprint, s.xyz) : 0.0;
            like = like > 0.25 ? like : 0.0;
            vec2 f = max(1.0 - abs(vec2(tap) - at), 0.0);  // bilinear: 0 for all but four
            float weight = f.x * f.y;
            close += like * weight * light;
            closeWeight += like * weight;
            wide += like * light;
            wideWeight += like;
        }
    vec4 result = closeWeight > 0.01 ? close / closeWeight : wideWeight > 0.25 ? wide / wideWeight : vec4(0.0);
    result.a = motion.w > 0.0 ? min(result.a, kMostMovedLength) : result.a;
    if (any(greaterThanEqual(ivec2(gl_GlobalInvocationID.xy), size))) return;
    imageStore(surface, pixel, vec4(normal, depth));
    imageStore(history, pixel, known ? vec4(roundedByChance(result.rgb, pixel, push.p.seed + 7u), result.a) : vec4(0.0));
}
