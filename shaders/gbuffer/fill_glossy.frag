#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// With the target of specular reflectance, for scenes that have a glossy material.
#define AG_GLOSSY
#include "gbuffer/fill_surface.glsl"
