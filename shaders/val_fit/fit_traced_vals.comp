#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// For hosts that have trees of their occluders.
#define AG_TRACED
#include "val_fit/fit_vals.glsl"
