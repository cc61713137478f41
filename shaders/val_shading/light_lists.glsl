// Where a tile's list of near or far lights begins.
#ifndef AG_LIGHT_LISTS_GLSL
#define AG_LIGHT_LISTS_GLSL

#include "val_shading/val_shading_io.h"

uint listStart(uint tile, uint list, uint valCount) { return (tile * kLightLists + list) * valCount; }
#endif
