#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// What a surface lets through of the light behind it: past it where alpha does not cover, and tinted through it where it is a
// sheet of glass, but for what that reflects.
#define AG_SCENE_MATERIALS
#include "scene/scene.glsl"
#include "gbuffer/blended.glsl"

layout(set = 0, binding = 12, scalar) uniform Camera { CameraConstants camera; } camera;

layout(constant_id = 4) const bool kGlossy = true;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 3) in vec2 uv;
layout(location = 4) flat in uint material;
layout(location = 5) in vec3 color;

layout(location = 0) out vec4 veil;  // rgb: transmitted; a: coverage

void main() {
    SurfaceMaterial m = tintedMaterial(material, uv, color);
    Blend b = blendOf(material, m);
    float cosine = abs(dot(unitNormal(normal), normalize(camera.camera.position - position)));
    vec3 reflected = fresnelSchlick(specularF0(m.baseColor.rgb, m.metallic, m.specular),
                                    vec3(specularF90(m.metallic, m.specular)), cosine);
    if (!kGlossy) reflected = vec3(0.0);
    veil = vec4(sheetTransmits(m.baseColor.rgb, m.metallic, b.coverage, b.transmission, reflected), b.coverage);
}
