#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Outgoing radiance: albedo / pi times irradiance, what a specular lobe adds to that, and what surfaces emit.
#include "common/pixel_rays.h"

layout(constant_id = 0) const bool kDirect = true;    // compiled out where nothing lights the scene
layout(constant_id = 1) const bool kIndirect = true;
layout(constant_id = 2) const bool kEmissive = false;
layout(constant_id = 3) const bool kSpecular = false;
layout(constant_id = 4) const bool kSky = false;
layout(constant_id = 5) const bool kSkyPicture = false;
layout(constant_id = 6) const bool kHighlights = false;
layout(constant_id = 7) const bool kSkyGloss = false;

layout(push_constant, scalar) uniform Push { PixelRays rays; } push;

layout(set = 0, binding = 0) uniform sampler2D albedoMap;
layout(set = 0, binding = 1) uniform sampler2D directMap;
layout(set = 0, binding = 2) uniform sampler2D indirectMap;
layout(set = 0, binding = 3) uniform sampler2D emissiveMap;
layout(set = 0, binding = 4) uniform sampler2D depthMap;
layout(set = 0, binding = 5) uniform sampler2D specularMap;
layout(set = 0, binding = 6) uniform sampler2D skyMap;
layout(set = 0, binding = 7) uniform sampler2D skyPicture;  // equirectangular, see engine/scene/sky.h

layout(set = 0, binding = 8) uniform sampler2D highlightMap;
layout(set = 0, binding = 9) uniform sampler2D skyGlossMap;
layout(set = 0, binding = 10) uniform sampler2D reflectanceMap;  // read only if kSkyGloss

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 radiance;  // W/(m² sr)

// Rows end at the poles; columns go round.
vec3 seenSky(ivec2 pixel) {
    vec3 d = normalize(placeOf(push.rays, vec2(pixel), 1.0));
    float half_ = 0.5 / float(textureSize(skyPicture, 0).y);
    vec2 place = vec2(atan(d.z, d.x) / (2.0 * kPi) + 0.5, clamp(acos(clamp(d.y, -1.0, 1.0)) / kPi, half_, 1.0 - half_));
    return textureLod(skyPicture, place, 0.0).rgb;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 irradiance = vec3(0.0);
    if (kDirect) irradiance += texelFetch(directMap, pixel, 0).rgb;
    // Of light from everywhere a lobe keeps what it reflects head on from what is under it: over all half vectors Schlick's
    // reflectance rises by less than 0.03.
    vec3 kept = kSkyGloss ? texelFetch(reflectanceMap, pixel, 0).rgb : vec3(0.0);
    if (kSky) irradiance += texelFetch(skyMap, pixel, 0).rgb * (1.0 - kept);
    if (kIndirect) irradiance += texelFetch(indirectMap, pixel, 0).rgb;
    vec3 result = texelFetch(albedoMap, pixel, 0).rgb * irradiance * kInvPi;
    if (kSpecular) result += texelFetch(specularMap, pixel, 0).rgb;
    if (kSkyGloss) result += texelFetch(skyGlossMap, pixel, 0).rgb;
    if (kHighlights) result += texelFetch(highlightMap, pixel, 0).rgb;
    result = max(result, vec3(0.0));
    if (kEmissive) result += texelFetch(emissiveMap, pixel, 0).rgb;
    bool surface = texelFetch(depthMap, pixel, 0).x > 0.0;
    vec3 behind = kSkyPicture && !surface ? seenSky(pixel) : vec3(0.0);
    radiance = surface ? vec4(min(result, vec3(kMostHalf)), 1.0) : vec4(min(behind, vec3(kMostHalf)), 0.0);
}
