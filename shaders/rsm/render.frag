#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// What a bounce light sees. The vertex normal, not the normal map: an emitter is a piece of surface, and the directions of
// bumps below its size cancel out. That bumps receive less light than a smooth surface is in the albedo.
#define AG_SCENE_MATERIALS
#include "common/brdf.h"
#include "scene/scene.glsl"

layout(constant_id = 4) const bool kWholeMaterials = false;  // else their Lambert part

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
layout(location = 4) flat in uint material;
layout(location = 5) in vec3 color;

layout(location = 0) out vec4 outNormal;  // a: roughness
layout(location = 1) out vec4 outAlbedo;  // a: what the lobe reflects head on, mean of the channels; 0: it has none

void main() {
    SurfaceMaterial m = tintedMaterial(material, uv, color);
    vec3 n = unitNormal(normal);
    outNormal = vec4(gl_FrontFacing ? n : -n, m.roughness);
    vec3 albedo = bounceAlbedo(material, m, kWholeMaterials);
    if (kTextureClass != 0 && m.layers.z >= 0)
        albedo *= bumpCosine(sampleLinear(m.uv, m.layers.z).xyz * 2.0 - 1.0, m.normalScale);
    vec3 f0 = specularF0(m.baseColor.rgb, m.metallic, m.specular);
    outAlbedo = vec4(albedo, kWholeMaterials ? (f0.r + f0.g + f0.b) / 3.0 : 0.0);
}
