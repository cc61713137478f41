#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#define AG_SHADOW
#define AG_TRACED
#include "direct_lighting/shade_punctual.glsl"
