// The scene as the GPU sees it. Positions in metres relative to RenderScene::originWorld. Scalar layout;
// arrays that shaders read through texel buffers are whole vec4s.
#ifndef AG_SCENE_IO_H
#define AG_SCENE_IO_H

#include "common/portable.h"

#ifdef __cplusplus
namespace ag::io {
#endif

struct CameraConstants {
    mat4 clipFromWorld;  // reversed depth, infinite far plane
    mat4 worldFromClip;
    vec3 position;  // m
    float near;     // m
    uvec2 size;     // pixels
};

struct Instance {          // 4 vec4
    vec4 worldFromLocal0;  // rows of the 3x4 matrix
    vec4 worldFromLocal1;
    vec4 worldFromLocal2;
    uvec4 ids;  // x: material, y: primitive, z: skinned mesh or kNoSkinnedMesh
};

const uint kNoSkinnedMesh = 0xffffffffu;

struct Material {       // 6 vec4
    vec4 baseColor;     // linear factor
    vec3 emissive;      // W/(m² sr)
    float alphaCutoff;  // 0 unless masked; -1: blended, and covers whatever its alpha
    float metallic;
    float roughness;
    float specular;
    float normalScale;
    ivec4 layers;  // base colour, emissive, normal, metallic-roughness; -1: none
    vec4 uvRow0;   // u' = dot(row.xy, uv) + row.z; row0.w: 1 if double sided
    vec4 uvRow1;   // w: transmission
};

const uint kLightDirectional = 0;
const uint kLightPoint = 1;
const uint kLightSpot = 2;

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
