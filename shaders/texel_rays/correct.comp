#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The area lights' sum, corrected by what the rays found, as far as that stands out of its noise (Wiener's share: what is
// known over that and what is noise).
layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D areaLights;
layout(set = 0, binding = 1) uniform sampler2D rest;
layout(set = 0, binding = 2) uniform sampler2D shareOf;
layout(set = 0, binding = 3, rgba16f) uniform writeonly image2D irradiance;

const float kMostHalf = 65504.0;

void main() {
    ivec2 size = imageSize(irradiance), pixel = ivec2(gl_GlobalInvocationID.xy), at = min(pixel, size - 1);
    vec4 lights = texelFetch(areaLights, at, 0), r = texelFetch(rest, at, 0);
    vec3 correction = r.rgb + (texelFetch(shareOf, at, 0).x - 1.0) * lights.rgb;
    float known = dot(correction, correction) / 3.0, trust = known / max(known + r.a, 1e-30);
    if (all(lessThan(pixel, size)))
        imageStore(irradiance, pixel, vec4(clamp(lights.rgb + trust * correction, vec3(0.0), vec3(kMostHalf)), lights.a));
}
