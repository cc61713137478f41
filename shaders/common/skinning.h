// Linear-blend skinning: a vertex is moved by the weighted mean of its joints' matrices.
#ifndef AG_SKINNING_H
#define AG_SKINNING_H

#include "common/portable.h"

AG_BEGIN

struct SkinMatrix {  // rows of a 3x4 matrix
    vec4 row0;
    vec4 row1;
    vec4 row2;
};

AG_FUNCTION SkinMatrix blendJoints(SkinMatrix a, SkinMatrix b, SkinMatrix c, SkinMatrix d, vec4 weights) {
    SkinMatrix m;
    m.row0 = a.row0 * weights.x + b.row0 * weights.y + c.row0 * weights.z + d.row0 * weights.w;
    m.row1 = a.row1 * weights.x + b.row1 * weights.y + c.row1 * weights.z + d.row1 * weights.w;
    m.row2 = a.row2 * weights.x + b.row2 * weights.y + c.row2 * weights.z + d.row2 * weights.w;
    return m;
}

AG_FUNCTION vec3 skinPoint(SkinMatrix m, vec3 p) {
    vec4 h = vec4(p, 1.0f);
    return vec3(dot(m.row0, h), dot(m.row1, h), dot(m.row2, h));
}

AG_FUNCTION vec3 skinDirection(SkinMatrix m, vec3 d) {
    return vec3(dot(vec3(m.row0), d), dot(vec3(m.row1), d), dot(vec3(m.row2), d));
}

// By the cofactor matrix: right for any scale, also mirrored ones. Unit, or zero where joints cancel.
AG_FUNCTION vec3 skinNormal(SkinMatrix m, vec3 n) {
    vec3 cofactor0 = cross(vec3(m.row1), vec3(m.row2));
    vec3 cofactor1 = cross(vec3(m.row2), vec3(m.row0));
    vec3 cofactor2 = cross(vec3(m.row0), vec3(m.row1));
    vec3 turned =
        vec3(dot(cofactor0, n), dot(cofactor1, n), dot(cofactor2, n)) * sign(dot(vec3(m.row0), cofactor0));
    return turned * inversesqrt(max(dot(turned, turned), 1e-37f));
}

AG_END

#endif
