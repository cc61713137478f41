#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Importance of each block over the RSMs, black where nothing is lit.
#include "common/false_color.h"
#include "importance/pyramid.glsl"
#include "rsm/rsm_io.h"

layout(push_constant, scalar) uniform Push { ImportanceSettings settings; } push;
layout(set = 0, binding = 0, scalar) uniform Faces { RsmFace items[kMaxRsmFaces]; } faces;
layout(set = 0, binding = 1, scalar) readonly buffer Pyramid { float items[]; } pyramid;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;

void main() {
    uvec2 coord = uvec2(gl_FragCoord.xy);
    float importance = 0.0;
    for (uint i = 0; i < push.settings.faceCount; ++i) {
        uvec2 origin = faces.items[i].origin;
        uint size = faces.items[i].size;
        if (any(lessThan(coord, origin)) || any(greaterThanEqual(coord, origin + size))) continue;
        importance = pyramid.items[i * push.settings.pyramidStride +
                                   mortonFromCell((coord - origin) / blockSide(size))];
    }
    color = vec4(importance > 0.0 ? heat(clamp(importance, 0.0, 1.0)) : vec3(0.0), 1.0);
}
