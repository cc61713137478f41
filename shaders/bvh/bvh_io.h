// Occluders as bounding volume hierarchies: one of all that is static, one a mesh that moves, and one over
// the movable instances' boxes. Each lies in a grid of its own; its triangles are stored in the grid's
// coordinates too, so that a ray is brought into it once.
#ifndef AG_BVH_IO_H
#define AG_BVH_IO_H

#include "common/portable.h"

#ifdef __cplusplus
namespace ag::io {
#endif

const float kBvhGrid = 65535.0f;  // a node's box in sixteen-bit steps
const uint kBvhLeafBit = 0x80000000u;
const uint kBvhCountShift = 27u,
           kBvhMostLeafItems = 15u;  // of a leaf: how many items; below it the first one
const uint kBvhMostItems = 1u << 27;

// A node, uvec4: least x y, least z most x, most y z (16 bits each), then of an inner node the node after its
// subtree.

const float kBvhOffset = 1e-4f;  // of rays' starts from their surfaces, in the scene's extent
struct BvhTriangle {             // 3 vec4
    vec3 corner;
    float opacity;  // share of it that an alpha mask leaves
    vec3 edge1;
    float reflects;  // packReflectance of its mean, and one more; negative: its front is not where edge1 x
                     // edge2 points
    vec3 edge2;
    float shines;  // packRadiance of its mean, and one more; negative: both of its sides are fronts
};

struct BvhMask {         // 2 vec4: where a triangle is cut out
    vec2 uv0, uv1, uv2;  // of its corners in the texture
    float imageCode;     // of its class and layer (packMask); 0: it has none
    float leastAlpha;    // of what is not cut out
};

// Where rays meet a tree. Read as whole words.
struct BvhPlace {                                         // 4 uvec4
    vec4 gridFromWorld0, gridFromWorld1, gridFromWorld2;  // rows
    uint firstNode, endNode;
    uvec2 spare;
};

// Rows of places: of static surfaces, of the tree over movable instances (its items are rows, counted from
// the third on), then those of these.
const uint kBvhStatic = 0u, kBvhMovers = 1u, kBvhFirstMover = 2u;

#ifdef __cplusplus
}  // namespace ag::io
#endif

AG_BEGIN

AG_FUNCTION float packMask(uint textureClass, uint layer) {
    return float(layer * 8u + textureClass);
}

// Eight bits a channel, by their roots, so that dark surfaces keep their colour; a float holds 24 bits.
AG_FUNCTION float packReflectance(vec3 r) {
    vec3 code = floor(sqrt(clamp(r, vec3(0.0f), vec3(1.0f))) * 255.0f + 0.5f);
    return code.x + code.y * 256.0f + code.z * 65536.0f;
}
AG_FUNCTION vec3 unpackReflectance(float code) {
    vec3 high = floor(code * vec3(1.0f, 1.0f / 256.0f, 1.0f / 65536.0f));
    vec3 root = (high - 256.0f * floor(high * (1.0f / 256.0f))) / 255.0f;
    return root * root;
}

// Six bits a channel and of their exponent, of radiance from 2^-38 to 2^32.
AG_FUNCTION float packRadiance(vec3 r) {
    float most = max(r.x, max(r.y, r.z));
    float exponent = clamp(floor(log2(max(most, 1e-20f))) + 1.0f, -31.0f, 32.0f);
    vec3 code = min(floor(max(r, vec3(0.0f)) * exp2(6.0f - exponent) + 0.5f), vec3(63.0f));
    return code.x + code.y * 64.0f + code.z * 4096.0f + (exponent + 31.0f) * 262144.0f;
}
AG_FUNCTION vec3 unpackRadiance(float code) {
    vec4 high = floor(code * vec4(1.0f, 1.0f / 64.0f, 1.0f / 4096.0f, 1.0f / 262144.0f));
    vec3 mantissa = vec3(high.x - 64.0f * high.y, high.y - 64.0f * high.z, high.z - 64.0f * high.w);
    return mantissa * exp2(high.w - 31.0f - 6.0f);
}

// Of a triangle: where edge1 x edge2 points (1), on the other side (-1), on both (0).
AG_FUNCTION float frontOf(float reflects, float shines) {
    return shines < 0.0f ? 0.0f : sign(reflects);
}
AG_FUNCTION vec3 reflectanceOf(float reflects) {
    return unpackReflectance(abs(reflects) - 1.0f);
}
AG_FUNCTION vec3 radianceOf(float shines) {
    return unpackRadiance(abs(shines) - 1.0f);
}

AG_END
#endif
