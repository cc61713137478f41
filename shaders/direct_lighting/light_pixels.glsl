// Irradiance straight from the lights, one pass a light so that its kind is known when the shader is compiled.
// Shadow by 25 taps of the light's map, tent-weighted so that the edge moves smoothly.
#include "common/lights.h"
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
// The cube face a direction points to: +x -x +y -y +z -z.
uint cubeFace(vec3 d) {
    vec3 a = abs(d);
    if (a.x >= a.y && a.x >= a.z) return d.x > 0.0 ? 0 : 1;
    if (a.y >= a.z) return d.y > 0.0 ? 2 : 3;
    return d.z > 0.0 ? 4 : 5;
}

uint chooseView(Light light, vec3 position, float viewDepth) {
    if (kKind == kLightPoint) return light.firstShadowView + cubeFace(position - light.position);
    uint view = light.firstShadowView;
    if (kKind == kLightDirectional)
        for (uint i = 0; i + 1 < light.shadowViewCount; ++i)
            view += viewDepth > shadowViews.items[light.firstShadowView + i].farDistance ? 1 : 0;
    return view;
}

// Share of the light that arrives. The receiver is pushed off its surface by about a filter's width of texels.
float litShare(Light light, vec3 position, vec3 normal, vec3 toLight, float viewDepth) {
    ShadowView view = shadowViews.items[chooseView(light, position, viewDepth)];
    float texel = view.texelSize;
    if (kKind != kLightDirectional) texel *= length(light.position - position);
    float slope = sqrt(max(1.0 - dot(normal, toLight) * dot(normal, toLight), 0.0));
    vec3 pushed = position + (normal * (0.5 + 2.0 * slope) + toLight * 0.5) * texel;
    vec4 clip = view.clipFromWorld * vec4(pushed, 1.0);
    vec3 ndc = clip.xyz / max(clip.w, 1e-6);
    vec2 at = (ndc.xy * 0.5 + 0.5) * float(view.size);
    bool outside = clip.w <= 0.0 || any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(at, vec2(view.size)));

    vec2 corner = floor(at - 0.5);
    vec2 f = at - 0.5 - corner;
    ivec2 low = ivec2(view.origin), high = low + int(view.size) - 1;
    float lit = 0.0;
    [[unroll]] for (int y = -2; y <= 2; ++y) {
        [[unroll]] for (int x = -2; x <= 2; ++x) {
            ivec2 tap = clamp(low + ivec2(corner) + ivec2(x, y), low, high);
            float wx = x == -2 ? 1.0 - f.x : (x == 2 ? f.x : 1.0);
            float wy = y == -2 ? 1.0 - f.y : (y == 2 ? f.y : 1.0);
            lit += wx * wy * shadowCompare(texelFetch(shadowAtlas, tap, 0).x, ndc.z, 0.0);
        }
    }
    return outside ? 1.0 : lit / 16.0;
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
