// Unit vectors on the octahedron unfolded to [-1, 1]².
#ifndef AG_OCTAHEDRAL_H
#define AG_OCTAHEDRAL_H

#include "common/portable.h"

AG_BEGIN

AG_FUNCTION vec2 octFold(vec2 e) {
    return vec2((1.0f - abs(e.y)) * (e.x >= 0.0f ? 1.0f : -1.0f),
                (1.0f - abs(e.x)) * (e.y >= 0.0f ? 1.0f : -1.0f));
}

AG_FUNCTION vec2 octEncode(vec3 n) {
    float l1 = abs(n.x) + abs(n.y) + abs(n.z);
    vec2 e = vec2(n.x, n.y) / l1;
    return n.z >= 0.0f ? e : octFold(e);
}

AG_FUNCTION vec3 octDecode(vec2 e) {
    float z = 1.0f - abs(e.x) - abs(e.y);
    vec2 xy = z >= 0.0f ? e : octFold(e);
    return normalize(vec3(xy.x, xy.y, z));
}

AG_END
#endif
