// Reading instances and materials through texel buffers, and the vertex side every raster pass shares.
#ifndef AG_SCENE_GLSL
#define AG_SCENE_GLSL

#include "common/brdf.h"
#include "common/texels.glsl"
#include "scene/alpha.glsl"
#include "scene/scene_io.h"

// Interpolated normals may cancel: zero stays zero.
vec3 unitNormal(vec3 n) { return n * inversesqrt(max(dot(n, n), 1e-37)); }

#ifdef AG_SCENE_INSTANCES
layout(set = 0, binding = 0) VEC4_TEXELS(instances);

struct InstanceTransform {
    vec4 row0, row1, row2;
    uint material, skinnedMesh;
};

InstanceTransform fetchInstance(int slot) {
    InstanceTransform t;
    t.row0 = fetchTexel(instances, slot * 4 + 0);
    t.row1 = fetchTexel(instances, slot * 4 + 1);
    t.row2 = fetchTexel(instances, slot * 4 + 2);
    vec4 ids = fetchTexel(instances, slot * 4 + 3);
    t.material = floatBitsToUint(ids.x);
    t.skinnedMesh = floatBitsToUint(ids.z);
    return t;
}

vec3 transformPoint(InstanceTransform t, vec3 p) {
    vec4 h = vec4(p, 1.0);
    return vec3(dot(t.row0, h), dot(t.row1, h), dot(t.row2, h));
}

vec3 transformDirection(InstanceTransform t, vec3 d) {
    return vec3(dot(t.row0.xyz, d), dot(t.row1.xyz, d), dot(t.row2.xyz, d));
}

// -1 where a mirrored scale turns triangles over.
float handednessOf(InstanceTransform t) { return sign(dot(t.row0.xyz, cross(t.row1.xyz, t.row2.xyz))); }

// By the cofactor matrix: right for any scale, also mirrored ones.
vec3 transformNormal(InstanceTransform t, vec3 n) {
    vec3 cofactor0 = cross(t.row1.xyz, t.row2.xyz);
    vec3 cofactor1 = cross(t.row2.xyz, t.row0.xyz);
    vec3 cofactor2 = cross(t.row0.xyz, t.row1.xyz);
    return handednessOf(t) * vec3(dot(cofactor0, n), dot(cofactor1, n), dot(cofactor2, n));
}
#endif

#ifdef AG_SCENE_DRAWS
// The instances that each draw takes, from its firstInstance on.
layout(set = 0, binding = 11) UINT_TEXELS(drawnRows);

int drawnInstance() { return int(fetchTexel(drawnRows, gl_InstanceIndex).x); }
#endif

#ifdef AG_SCENE_MATERIALS
// The variant of a draw: material features are compiled in or out.
layout(constant_id = 0) const uint kTextureClass = 0;  // TextureClass: 0 means no texture at all
layout(constant_id = 1) const bool kAlphaMask = false;
layout(constant_id = 2) const bool kNormalMaps = false;
layout(constant_id = 3) const bool kVertexColors = false;

layout(set = 0, binding = 1) VEC4_TEXELS(materials);
layout(set = 0, binding = 2) uniform sampler2DArray srgb256;
layout(set = 0, binding = 3) uniform sampler2DArray srgb512;
layout(set = 0, binding = 4) uniform sampler2DArray srgb1024;
layout(set = 0, binding = 5) uniform sampler2DArray srgb2048;
layout(set = 0, binding = 6) uniform sampler2DArray linear256;
layout(set = 0, binding = 7) uniform sampler2DArray linear512;
layout(set = 0, binding = 8) uniform sampler2DArray linear1024;
layout(set = 0, binding = 9) uniform sampler2DArray linear2048;

vec4 sampleSrgb(vec2 uv, int layer) {
    vec3 at = vec3(uv, float(max(layer, 0)));
    vec4 texel = vec4(1.0);
    if (kTextureClass == 1) texel = texture(srgb256, at);
    if (kTextureClass == 2) texel = texture(srgb512, at);
    if (kTextureClass == 3) texel = texture(srgb1024, at);
    if (kTextureClass == 4) texel = texture(srgb2048, at);
    return layer < 0 ? vec4(1.0) : texel;
}

float sampleAlpha(vec2 uv, int layer) {
    float alpha = 1.0;
    if (kTextureClass == 1 && layer >= 0) alpha = finestAlpha(srgb256, uv, layer);
    if (kTextureClass == 2 && layer >= 0) alpha = finestAlpha(srgb512, uv, layer);
    if (kTextureClass == 3 && layer >= 0) alpha = finestAlpha(srgb1024, uv, layer);
    if (kTextureClass == 4 && layer >= 0) alpha = finestAlpha(srgb2048, uv, layer);
    return alpha;
}

vec4 sampleLinear(vec2 uv, int layer) {
    vec3 at = vec3(uv, float(max(layer, 0)));
    vec4 texel = vec4(1.0);
    if (kTextureClass == 1) texel = texture(linear256, at);
    if (kTextureClass == 2) texel = texture(linear512, at);
    if (kTextureClass == 3) texel = texture(linear1024, at);
    if (kTextureClass == 4) texel = texture(linear2048, at);
    return texel;
}

struct SurfaceMaterial {
    vec4 baseColor;
    vec3 emissive;
    float metallic, roughness, specular, normalScale;
    ivec4 layers;
    vec2 uv;
};

bool isDoubleSided(uint material) { return fetchTexel(materials, int(material) * 6 + 4).w > 0.0; }

// Base colour, metallic and roughness with their textures applied; discards below the alpha cut-off.
SurfaceMaterial fetchMaterial(uint index, vec2 uv) {
    int base = int(index) * 6;
    vec4 emissiveCutoff = fetchTexel(materials, base + 1);
    vec4 factors = fetchTexel(materials, base + 2);
    SurfaceMaterial m;
    m.baseColor = fetchTexel(materials, base);
    float alpha = m.baseColor.a;
    m.emissive = emissiveCutoff.xyz;
    m.metallic = factors.x;
    m.roughness = factors.y;
    m.specular = factors.z;
    m.normalScale = factors.w;
    m.layers = ivec4(-1);
    m.uv = uv;
    if (kTextureClass != 0) {
        m.layers = floatBitsToInt(fetchTexel(materials, base + 3));
        vec4 row0 = fetchTexel(materials, base + 4);
        vec4 row1 = fetchTexel(materials, base + 5);
        m.uv = vec2(dot(row0.xy, uv) + row0.z, dot(row1.xy, uv) + row1.z);
        m.baseColor *= sampleSrgb(m.uv, m.layers.x);
        if (kAlphaMask) alpha *= sampleAlpha(m.uv, m.layers.x);
        vec4 metallicRoughness = sampleLinear(m.uv, m.layers.w);
        m.metallic *= m.layers.w < 0 ? 1.0 : metallicRoughness.b;
        m.roughness *= m.layers.w < 0 ? 1.0 : metallicRoughness.g;
    }
    if (kAlphaMask && alpha < emissiveCutoff.w) discard;
    return m;
}

// With the colours of the vertices about it.
SurfaceMaterial tintedMaterial(uint index, vec2 uv, vec3 color) {
    SurfaceMaterial m = fetchMaterial(index, uv);
    if (kVertexColors) m.baseColor.rgb *= color;
    return m;
}

// Of an RSM's texel. A single-sided surface blocks light from both sides and reflects it from the front alone,
// where a camera sees it. `whole`: with what the specular lobe reflects.
vec3 bounceAlbedo(uint material, SurfaceMaterial m, bool whole) {
    if (!gl_FrontFacing && !isDoubleSided(material)) return vec3(0.0);
    return whole ? wholeReflectance(m.baseColor.rgb, m.metallic, m.roughness, m.specular)
                 : diffuseAlbedo(m.baseColor.rgb, m.metallic);
}
#endif

#endif
