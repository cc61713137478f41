#version 460
#extension GL_GOOGLE_include_directive : require
#define THIN_FORMAT r32f
#include "gbuffer/thin.glsl"
