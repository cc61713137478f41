#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// What a bounce light sees. The vertex normal, not the normal map: an emitter is a piece of surface, and the directions of
// bumps below its size cancel out. What bumps receive over what a smooth surface would is in the albedo.
#define AG_SCENE_MATERIALS
#include "common/brdf.h"
#include "scene/scene.glsl"
#include "scene/surface_normal.glsl"

layout(push_constant, scalar) uniform Push { mat4 clipFromWorld; } push;

layout(constant_id = 4) const bool kWholeMaterials = false;  // else their Lambert part

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
layout(location = 4) flat in uint material;
layout(location = 5) in vec3 color;

layout(location = 0) out vec4 outNormal;  // a: roughness
layout(location = 1) out vec4 outAlbedo;  // a: what the lobe reflects head on, mean of the channels; 0: it has none

const float kLeastCosine = 0.01;

// Along the light's ray through a place, unit, to the side of the normal n: the direction in which its place in the map stays.
vec3 towardLight(vec3 place, vec3 n) {
    mat4 rows = transpose(push.clipFromWorld);
    vec4 clip = push.clipFromWorld * vec4(place, 1.0);
    vec3 ray = normalize(cross(rows[0].xyz * clip.w - rows[3].xyz * clip.x, rows[1].xyz * clip.w - rows[3].xyz * clip.y));
    return faceforward(ray, -ray, n);
}

void main() {
    SurfaceMaterial m = tintedMaterial(material, uv, color);
    vec3 front = unitNormal(normal), n = gl_FrontFacing ? front : -front;
    outNormal = vec4(n, m.roughness);
    vec3 albedo = bounceAlbedo(material, m, kWholeMaterials);
    if (kTextureClass != 0 && m.layers.z >= 0) {
        vec3 bumps = fromFrame(tangentFrame(m, position, front, tangent), scaledBumps(mappedNormal(m), m.normalScale));
        vec3 toLight = towardLight(position, n);
        float cosine = dot(toLight, n);
        albedo *= bumpCosine(gl_FrontFacing ? bumps : -bumps, toLight, cosine) / max(cosine, kLeastCosine);
    }
    vec3 f0 = specularF0(m.baseColor.rgb, m.metallic, m.specular);
    outAlbedo = vec4(albedo, kWholeMaterials ? (f0.r + f0.g + f0.b) / 3.0 : 0.0);
}
