// The frame of a normal map (glTF 2.0, 3.9.3): x along texture's u, y against its v, which points down, z
// along the surface's normal.
#ifndef AG_TANGENT_FRAME_H
#define AG_TANGENT_FRAME_H

#include "common/portable.h"

AG_BEGIN

struct TangentFrame {
    vec3 t, b, n;
};

AG_FUNCTION vec3 acrossNormal(vec3 n, vec3 along) {
    vec3 t = along - n * dot(n, along);
    return t * inversesqrt(max(dot(t, t), 1e-36f));
}

// Of a file's tangent (w: handedness).
AG_FUNCTION TangentFrame frameOfTangent(vec3 n, vec4 tangent) {
    vec3 t = acrossNormal(n, vec3(tangent.x, tangent.y, tangent.z));
    return TangentFrame(t, cross(n, t) * tangent.w, n);
}

// Of the place's steps `px`, `py` along two directions and those of its texture coordinates: as MikkTSpace
// has it, which glTF asks for where a file has no tangents, but for each triangle by itself. Mirrored ones
// have y turned over.
AG_FUNCTION TangentFrame frameOfSteps(vec3 n, vec3 px, vec3 py, vec2 uvx, vec2 uvy) {
    float side = uvx.x * uvy.y - uvx.y * uvy.x < 0.0f ? -1.0f : 1.0f;
    vec3 alongU = side * (px * uvy.y - py * uvx.y), alongV = side * (py * uvx.x - px * uvy.x);
    vec3 t = acrossNormal(n, alongU), b = cross(n, t);
    return TangentFrame(t, dot(b, alongV) > 0.0f ? -b : b, n);
}

// `mapped`: in the frame.
AG_FUNCTION vec3 fromFrame(TangentFrame f, vec3 mapped) {
    return f.t * mapped.x + f.b * mapped.y + f.n * mapped.z;
}

AG_END
#endif
