#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// For scenes with skinned meshes.
#define AG_SKINNED
#include "surface_emitters/emit.glsl"
