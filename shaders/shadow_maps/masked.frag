#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define AG_SCENE_MATERIALS
#include "scene/scene.glsl"

layout(location = 0) in vec2 uv;
layout(location = 1) flat in uint material;

void main() {
    fetchMaterial(material, uv);  // discards below the cut-off
}
