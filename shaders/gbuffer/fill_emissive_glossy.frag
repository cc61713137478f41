#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// With both targets that most scenes do without.
#define AG_EMISSIVE
#define AG_GLOSSY
#include "gbuffer/fill_surface.glsl"
