// The matrix that moves a vertex of a skinned mesh, from joints in a texel buffer of three vec4 each.
#ifndef AG_SKIN_GLSL
#define AG_SKIN_GLSL

#include "common/skinning.h"
#include "skinning/skinning_io.h"

// Macros, as functions take no texel buffers.
#define AG_JOINT(source, index)                                                                    \
    SkinMatrix(fetchTexel(source, int(index) * 3), fetchTexel(source, int(index) * 3 + 1),         \
               fetchTexel(source, int(index) * 3 + 2))

#define AG_SKIN(source, first, vertex)                                                             \
    blendJoints(AG_JOINT(source, (first) + ((vertex).joints.x & 0xffffu)),                         \
                AG_JOINT(source, (first) + ((vertex).joints.x >> 16)),                             \
                AG_JOINT(source, (first) + ((vertex).joints.y & 0xffffu)),                         \
                AG_JOINT(source, (first) + ((vertex).joints.y >> 16)), (vertex).weights)
#endif
