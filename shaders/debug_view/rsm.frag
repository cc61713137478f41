#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The RSMs as radiosity, flux over area, in W/m².
#include "common/texels.glsl"
#include "rsm/rsm.glsl"

layout(push_constant, scalar) uniform Push { RsmAtlas atlas; float light; } push;  // light: its unit, W/m²
layout(set = 0, binding = 0) VEC4_TEXELS(texels);
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;

void main() {
    uvec2 coord = uvec2(gl_FragCoord.xy);
    uint index = rsmIndexOfCoord(coord, push.atlas.size.x);
    RsmSurface s = AG_RSM_FETCH(texels, index);
    color = vec4(s.weight > 0.0 ? push.light * s.flux / s.area : vec3(0.0), 1.0);
}
