#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#define AG_TRACED
#include "direct_lighting/direct_lighting_io.h"
#include "direct_lighting/sun_pixels.glsl"
