#version 460
#extension GL_GOOGLE_include_directive : require
#define DOWNSAMPLED_FORMAT rgba16f
#include "gbuffer/downsample.glsl"
