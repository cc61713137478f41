// How much of a light arrives by a view of its depth atlas. Needs sampler `shadowAtlas`.
#ifndef AG_SHADOW_LOOKUP_GLSL
#define AG_SHADOW_LOOKUP_GLSL

#include "common/sampling.h"
#include "common/shadow_math.h"

struct ShadowMap {  // a square of the atlas
    mat4 clipFromWorld;
    uvec2 origin;
    uint size;
};

// Texel coordinates in a shadow view and reversed depth; z < 0 behind the light.
vec3 shadowPoint(ShadowMap map, vec3 position) {
    vec4 clip = map.clipFromWorld * vec4(position, 1.0);
    vec3 ndc = clip.xyz / max(clip.w, 1e-6);
    return vec3((ndc.xy * 0.5 + 0.5) * float(map.size), clip.w > 0.0 ? ndc.z : -1.0);
}

// How depth changes a texel along the receiver's plane, which stays a plane in the view: from two steps within
// it. Held to what 64 texels towards the light make, for planes seen edge-on.
vec2 receiverSlope(ShadowMap map, vec3 position, vec3 normal, vec3 toLight, float texel, vec3 at) {
    vec3 t, b;
    orthonormalBasis(normal, t, b);
    vec3 d1 = shadowPoint(map, position + t * texel) - at, d2 = shadowPoint(map, position + b * texel) - at;
    float most = abs(shadowPoint(map, position + toLight * (64.0 * texel)).z - at.z);
    float determinant = d1.x * d2.y - d1.y * d2.x;
    float scale = 1.0 / (abs(determinant) > 1e-6 ? determinant : 1e-6);
    vec2 slope = vec2(d1.z * d2.y - d2.z * d1.y, d2.z * d1.x - d1.z * d2.x) * scale;
    return clamp(slope, vec2(-most), vec2(most));
}

// Share of the light that arrives. Each tap is held against the receiver's plane at that tap, so that a flat
// surface does not shadow itself however wide the filter; a push of a quarter texel covers rounding. Planes seen
// nearly edge-on, which cross much depth within a texel, are given half of that as a tolerance. Where the map shows
// neither the plane nor anything before it the surface has ended there: such taps count as lit only if others are,
// else light from beyond a wall would come in along its corners.
// `texel`: m at the receiver.
float litShare(ShadowMap map, float texel, vec3 position, vec3 normal, vec3 toLight) {
    vec3 pushed = position + (normal + toLight) * (0.25 * texel);
    vec3 point = shadowPoint(map, pushed);
    vec2 at = point.xy;
    // The push may lead half a texel out of a cube's face.
    vec2 off = abs(at - 0.5 * float(map.size)) - 0.5 * float(map.size);
    bool outside = point.z < 0.0 || max(off.x, off.y) > 0.5;
    vec2 slope = receiverSlope(map, pushed, normal, toLight, texel, point);
    float texelDepth = max(abs(shadowPoint(map, pushed + toLight * texel).z - point.z), 1e-9);
    float tolerance = 0.5 * max(abs(slope.x) + abs(slope.y) - 2.0 * texelDepth, 0.0);
    float ends = 2.0 * texelDepth + tolerance;  // this far behind the plane is another surface

    // A box two texels wide about the receiver: three taps a row, the outer two by what it covers of them.
    vec2 corner = floor(at);
    vec2 f = at - corner;
    ivec2 low = ivec2(map.origin), high = low + int(map.size) - 1;
    float lit = 0.0, seen = 0.0, beyond = 0.0;
    [[unroll]] for (int y = -1; y <= 1; ++y) {
        [[unroll]] for (int x = -1; x <= 1; ++x) {
            ivec2 tap = clamp(low + ivec2(corner) + ivec2(x, y), low, high);
            float wx = x == -1 ? 1.0 - f.x : (x == 1 ? f.x : 1.0);
            float wy = y == -1 ? 1.0 - f.y : (y == 1 ? f.y : 1.0);
            vec2 offset = vec2(x, y) + 0.5 - f;  // from the receiver to the tap's centre, texels
            float receiver = point.z + dot(slope, offset);
            float stored = texelFetch(shadowAtlas, tap, 0).x;
            float there = clamp(2.0 - (receiver - stored) / ends, 0.0, 1.0);
            seen += wx * wy * there;
            beyond += wx * wy * (1.0 - there);
            lit += wx * wy * there * shadowCompare(stored, receiver + tolerance);
        }
    }
    bool nothingSeen = seen < 1e-3;
    lit += beyond * (nothingSeen ? 1.0 : min(4.0 * lit / seen, 1.0));
    return outside ? 1.0 : lit / 4.0;
}
#endif
