// Alpha of a texture's finest mip, bilinearly. Coarser mips average holes and leaves; testing that mean against the cut-off changes
// how much the surface covers. Filtered by hand: llvmpipe's anisotropic samplers ignore textureLod's level.
#ifndef AG_ALPHA_GLSL
#define AG_ALPHA_GLSL

float finestAlpha(sampler2DArray image, vec2 uv, int layer) {
    ivec2 size = textureSize(image, 0).xy;
    vec2 at = fract(uv) * vec2(size) - 0.5, f = at - floor(at);
    ivec2 low = ivec2(floor(at)) + size;
    vec4 corners;
    for (int i = 0; i < 4; ++i) corners[i] = texelFetch(image, ivec3((low + ivec2(i & 1, i >> 1)) % size, layer), 0).a;
    return mix(mix(corners[0], corners[1], f.x), mix(corners[2], corners[3], f.x), f.y);
}
#endif
