// Loops over lights in two shapes, chosen by specialisation. On CPU devices every lane of a subgroup loads another
// light and the lanes hand them round by shuffles: a load whose address depends on a loop counter is serialised
// there. On GPUs the natural loop with a uniform address is right.
#ifndef AG_LANE_LOOP_GLSL
#define AG_LANE_LOOP_GLSL

#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_EXT_control_flow_attributes : require

layout(constant_id = 100) const uint kSubgroupSize = 8;
layout(constant_id = 101) const bool kLaneParallel = true;

#endif
