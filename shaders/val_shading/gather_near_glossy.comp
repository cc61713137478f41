#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// And what a coat of gloss adds, for scenes that have such materials.
#define AG_GLOSSY
#include "val_shading/gather_near.glsl"
