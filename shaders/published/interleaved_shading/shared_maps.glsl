// Lights that look up the shadow map of their cluster (SSVP; Dong et al. 2009) instead of one of their own. Included
// before val_shading/area_light.glsl.
#ifndef AG_SHARED_MAPS_GLSL
#define AG_SHARED_MAPS_GLSL
#define AG_SHARED_MAPS

layout(constant_id = 4) const bool kSharedMaps = false;
const uint kNoMap = 0xffffu;  // nothing stands in the light's way
#endif
