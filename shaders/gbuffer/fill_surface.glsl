// What the camera sees: shading normal, diffuse albedo, emitted radiance, specular reflectance.
#define AG_SCENE_MATERIALS
#include "scene/scene.glsl"
#include "scene/surface_normal.glsl"
#include "common/brdf.h"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
layout(location = 4) flat in uint material;
layout(location = 5) in vec3 color;

layout(location = 0) out vec4 outNormal;  // xyz: unit; w: roughness
layout(location = 1) out vec4 outAlbedo;  // rgb: diffuse albedo; w: metallic
#ifdef AG_EMISSIVE
layout(location = 2) out vec4 outEmissive;  // W/(m² sr)
#endif
#ifdef AG_GLOSSY
#ifdef AG_EMISSIVE
layout(location = 3) out vec4 outReflectance;
#else
layout(location = 2) out vec4 outReflectance;  // rgb: head on; w: at grazing angles
#endif
#endif

#ifdef AG_BLENDED
#include "gbuffer/blended.glsl"
layout(constant_id = 4) const bool kFollows = false;  // a layer that is nearer
layout(set = 0, binding = 12) uniform sampler2D opaqueDepth;
layout(set = 0, binding = 13) uniform sampler2D nearerDepth;
layout(push_constant, scalar) uniform Push { layout(offset = 64) ivec2 origin; } push;  // after clipFromWorld

bool isPeeled(Blend b) {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    bool behind = gl_FragCoord.z <= texelFetch(opaqueDepth, push.origin + pixel, 0).x;
    bool before = kFollows && gl_FragCoord.z >= texelFetch(nearerDepth, pixel, 0).x;
    return behind || before || b.coverage < kLeastCoverage;
}
#endif

void main() {
    SurfaceMaterial m = tintedMaterial(material, uv, color);
    vec3 n = unitNormal(normal);
    if (kNormalMaps) n = bentNormal(m, position, n, tangent);
    if (!gl_FrontFacing) n = -n;
    outNormal = vec4(n, m.roughness);
    outAlbedo = vec4(diffuseAlbedo(m.baseColor.rgb, m.metallic), m.metallic);
#ifdef AG_EMISSIVE
    vec3 emissive = m.emissive;
    if (kTextureClass != 0) emissive *= sampleSrgb(m.uv, m.layers.y).rgb;
    outEmissive = vec4(min(emissive, vec3(kMostHalf)), 1.0);
#endif
#ifdef AG_GLOSSY
    outReflectance = vec4(specularF0(m.baseColor.rgb, m.metallic, m.specular), specularF90(m.metallic, m.specular));
#endif
#ifdef AG_BLENDED
    Blend b = blendOf(material, m);
    if (isPeeled(b)) discard;
    outAlbedo.rgb *= 1.0 - b.transmission;
#endif
}
