// Directions of a hemisphere to its square map, by one of two mappings chosen by specialisation.
#ifndef AG_ISM_MAP_GLSL
#define AG_ISM_MAP_GLSL

#include "common/hemisphere_map.h"
#include "ism_atlas/ism_atlas_io.h"

layout(constant_id = 3) const bool kParaboloid = false;

vec2 ismEncode(vec3 d) { return kParaboloid ? paraboloidEncode(d) : hemisphereEncode(d); }
vec3 ismDirection(vec2 uv) { return kParaboloid ? paraboloidDirection(uv) : hemisphereDirection(uv); }

void ismGradients(vec3 d, out vec3 u, out vec3 v) {
    if (kParaboloid) paraboloidGradients(d, u, v);
    else hemisphereGradients(d, u, v);
}

// Places farther than a texel's plane by less than half its width may show in it as well: the sides and the foot of a
// panel beside its front. `beyond` is over the plane's distance.
bool ismBeyond(float beyond, int size) { return beyond > 1.0 + kIsmHalfTexel / float(size); }
#endif
