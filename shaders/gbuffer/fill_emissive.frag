#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// With the emissive target, for scenes that have an emissive material.
#define AG_EMISSIVE
#include "gbuffer/fill_surface.glsl"
