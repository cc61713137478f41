#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The imperfect shadow maps side by side: distance along each texel's direction, m; 0 where nothing was met.
#include "common/texels.glsl"
#include "ism_atlas/ism_map.glsl"

layout(push_constant, scalar) uniform Push { uint mapCount, tileSize, columns; float metres; } push;  // metres: unit of length
layout(set = 0, binding = 0) VEC4_TEXELS(planes);
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;

void main() {
    uvec2 pixel = uvec2(gl_FragCoord.xy), map2 = pixel / push.tileSize, texel = pixel % push.tileSize;
    uint map = map2.y * push.columns + map2.x;
    float distance_ = 0.0;
    if (map < push.mapCount) {
        vec4 plane = fetchTexel(planes, int((map * push.tileSize + texel.y) * push.tileSize + texel.x));
        vec3 w = normalize(ismDirection((vec2(texel) + 0.5) / float(push.tileSize)));
        distance_ = plane.w > 0.0 ? min(1.0 / max(dot(plane.xyz, w), 1e-6), 1e3) : 0.0;
    }
    color = vec4(vec3(distance_ * push.metres), 1.0);
}
