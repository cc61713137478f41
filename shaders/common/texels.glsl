// Buffers whose elements invocations read here and there: texel buffers, which CPU devices read fastest; or, where texel
// buffers hold too few elements (DeviceInfo::storageTexels), storage buffers. Every such shader is compiled as both.
// layout(...) VEC4_TEXELS(name); then fetchTexel(name, index), whose components are .x to .w, or .x alone.
#ifndef AG_TEXELS_GLSL
#define AG_TEXELS_GLSL
#ifdef AG_STORAGE_TEXELS
#define VEC4_TEXELS(name) readonly buffer name##Texels { vec4 items[]; } name
#define FLOAT_TEXELS(name) readonly buffer name##Texels { float items[]; } name
#define UINT_TEXELS(name) readonly buffer name##Texels { uint items[]; } name
#define UVEC4_TEXELS(name) readonly buffer name##Texels { uvec4 items[]; } name
#define fetchTexel(name, index) name.items[index]
#else
#define VEC4_TEXELS(name) uniform samplerBuffer name
#define FLOAT_TEXELS(name) uniform samplerBuffer name
#define UINT_TEXELS(name) uniform usamplerBuffer name
#define UVEC4_TEXELS(name) uniform usamplerBuffer name
#define fetchTexel(name, index) texelFetch(name, index)
#endif
#endif
