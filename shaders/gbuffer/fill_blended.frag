#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The nearest of the surfaces that blend with what is behind them (depth peeling, Everitt 2001).
#define AG_EMISSIVE
#define AG_GLOSSY
#define AG_BLENDED
#include "gbuffer/fill_surface.glsl"
