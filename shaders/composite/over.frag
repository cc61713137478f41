#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Layers of surfaces that blend with what is behind them, over that: from the farthest to the nearest.
#include "common/portable.h"

layout(constant_id = 0) const uint kLayers = 1;
layout(push_constant, scalar) uniform Push { ivec2 origin; } push;  // of the layers in the picture

layout(set = 0, binding = 0) uniform sampler2D behindMap;
layout(set = 0, binding = 1) uniform sampler2D layer0;  // radiance of what they reflect and emit
layout(set = 0, binding = 2) uniform sampler2D layer1;
layout(set = 0, binding = 3) uniform sampler2D layer2;
layout(set = 0, binding = 4) uniform sampler2D layer3;
layout(set = 0, binding = 5) uniform sampler2D veil0;   // rgb: what they let through; a: how much they cover
layout(set = 0, binding = 6) uniform sampler2D veil1;
layout(set = 0, binding = 7) uniform sampler2D veil2;
layout(set = 0, binding = 8) uniform sampler2D veil3;

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 radiance;  // W/(m² sr)

vec3 over(vec3 behind, vec3 own, vec4 veil) { return min(veil.a * own + veil.rgb * behind, vec3(kMostHalf)); }

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy), at = pixel - push.origin;
    vec4 behind = texelFetch(behindMap, pixel, 0);
    radiance = behind;
    if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, textureSize(layer0, 0)))) return;
    vec3 seen = behind.rgb;
    if (kLayers > 3) seen = over(seen, texelFetch(layer3, at, 0).rgb, texelFetch(veil3, at, 0));
    if (kLayers > 2) seen = over(seen, texelFetch(layer2, at, 0).rgb, texelFetch(veil2, at, 0));
    if (kLayers > 1) seen = over(seen, texelFetch(layer1, at, 0).rgb, texelFetch(veil1, at, 0));
    seen = over(seen, texelFetch(layer0, at, 0).rgb, texelFetch(veil0, at, 0));
    radiance = vec4(seen, behind.a);
}
