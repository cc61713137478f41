// Irradiance straight from the lights, one pass a light so that its kind is known when the shader is compiled.
// Shadow by nine taps of the light's map, weighted so that the edge moves smoothly.
#include "common/lights.h"
#include "common/sampling.h"
#include "common/shadow_math.h"
#include "gbuffer/gbuffer.glsl"
#include "shadow_maps/shadow_maps_io.h"

layout(local_size_x = 16, local_size_y = 16) in;
layout(push_constant, scalar) uniform Push { uint light; } push;  // index into the lights
layout(constant_id = 0) const uint kKind = kLightSpot;
layout(constant_id = 1) const bool kFirst = true;  // starts from zero instead of adding

layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2, scalar) readonly buffer Camera { CameraConstants camera; } camera;
layout(set = 0, binding = 3, scalar) readonly buffer Lights { Light items[]; } lights;
layout(set = 0, binding = 4, rgba16f) uniform image2D irradiance;
#ifdef AG_SHADOW
layout(set = 0, binding = 5, scalar) readonly buffer ShadowViews { ShadowView items[]; } shadowViews;
layout(set = 0, binding = 6) uniform sampler2D shadowAtlas;
#endif

#ifdef AG_SHADOW
uint chooseView(Light light, vec3 position, float viewDepth) {
    if (kKind == kLightPoint) return light.firstShadowView + cubeFace(position - light.position);
    uint view = light.firstShadowView;
    if (kKind == kLightDirectional)
        for (uint i = 0; i + 1 < light.shadowViewCount; ++i)
            view += viewDepth > shadowViews.items[light.firstShadowView + i].farDistance ? 1 : 0;
    return view;
}

// Texel coordinates in a shadow view and reversed depth; z < 0 behind the light.
vec3 shadowPoint(ShadowView view, vec3 position) {
    vec4 clip = view.clipFromWorld * vec4(position, 1.0);
    vec3 ndc = clip.xyz / max(clip.w, 1e-6);
    return vec3((ndc.xy * 0.5 + 0.5) * float(view.size), clip.w > 0.0 ? ndc.z : -1.0);
}

// How depth changes a texel along the receiver's plane, which stays a plane in the view: from two steps within
// it. Held to what 64 texels towards the light make, for planes seen edge-on.
vec2 receiverSlope(ShadowView view, vec3 position, vec3 normal, vec3 toLight, float texel, vec3 at) {
    vec3 t, b;
    orthonormalBasis(normal, t, b);
    vec3 d1 = shadowPoint(view, position + t * texel) - at, d2 = shadowPoint(view, position + b * texel) - at;
    float most = abs(shadowPoint(view, position + toLight * (64.0 * texel)).z - at.z);
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
float litShare(Light light, vec3 position, vec3 normal, vec3 toLight, float viewDepth) {
    ShadowView view = shadowViews.items[chooseView(light, position, viewDepth)];
    float texel = view.texelSize;
    if (kKind != kLightDirectional) texel *= length(light.position - position);
    vec3 pushed = position + (normal + toLight) * (0.25 * texel);
    vec3 point = shadowPoint(view, pushed);
    vec2 at = point.xy;
    bool outside = point.z < 0.0 || any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(at, vec2(view.size)));
    vec2 slope = receiverSlope(view, pushed, normal, toLight, texel, point);
    float texelDepth = max(abs(shadowPoint(view, pushed + toLight * texel).z - point.z), 1e-9);
    float tolerance = 0.5 * max(abs(slope.x) + abs(slope.y) - 2.0 * texelDepth, 0.0);
    float ends = 2.0 * texelDepth + tolerance;  // this far behind the plane is another surface

    // A box two texels wide about the receiver: three taps a row, the outer two by what it covers of them.
    vec2 corner = floor(at);
    vec2 f = at - corner;
    ivec2 low = ivec2(view.origin), high = low + int(view.size) - 1;
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

vec3 irradianceFrom(Light light, vec3 position, vec3 normal, float viewDepth) {
    vec3 d = light.position - position;
    float distance = max(length(d), 1e-4);
    vec3 toLight = kKind == kLightDirectional ? -light.direction : d / distance;
    float cosine = max(dot(normal, toLight), 0.0);
    vec3 e = light.intensity * cosine;
    if (kKind != kLightDirectional) e *= rangeWindow(distance, light.range) / (distance * distance);
    if (kKind == kLightSpot) e *= spotFalloff(-dot(toLight, light.direction), light.cosInner, light.cosOuter);
#ifdef AG_SHADOW
    e *= litShare(light, position, normal, toLight, viewDepth);
#endif
    return e;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    uvec2 size = camera.camera.size;
    if (any(greaterThanEqual(pixel, ivec2(size)))) return;
    float depth = texelFetch(depthMap, pixel, 0).x;
    vec3 position = worldFromPixel(camera.camera.worldFromClip, size, pixel, depth);
    vec3 normal = texelFetch(normalMap, pixel, 0).xyz;
    float viewDepth = camera.camera.near / max(depth, 1e-9);
    vec3 e = depth > 0.0 ? irradianceFrom(lights.items[push.light], position, normal, viewDepth) : vec3(0.0);
    if (!kFirst) e += imageLoad(irradiance, pixel).rgb;
    imageStore(irradiance, pixel, vec4(e, 1.0));
}
