// A host's G-buffer in our form: depth as near / distance, a unit normal; for gloss roughness, diffuse albedo and
// reflectance too.
#include "common/brdf.h"
#include "common/octahedral.h"
#include "guest/guest_io.h"

layout(push_constant, scalar) uniform Push { ReadSurfacesPush p; } push;
layout(constant_id = 0) const uint kNormalEncoding = 0;  // AgiNormalEncoding

layout(set = 0, binding = 0) uniform sampler2D hostDepth;
layout(set = 0, binding = 1) uniform sampler2D hostNormal;
#ifdef AG_GLOSSY
layout(constant_id = 1) const uint kRoughnessChannel = 1;
layout(constant_id = 2) const uint kMetallicChannel = 2;
layout(set = 0, binding = 2) uniform sampler2D hostBaseColor;
layout(set = 0, binding = 3) uniform sampler2D hostMaterial;
#endif

layout(location = 0) out float outDepth;
layout(location = 1) out vec4 outNormal;
#ifdef AG_GLOSSY
layout(location = 2) out vec4 outAlbedo;
layout(location = 3) out vec4 outReflectance;
#endif

vec3 decodeNormal(vec4 texel) {
    vec3 n = kNormalEncoding == 0 ? texel.xyz : texel.xyz * 2.0 - 1.0;
    if (kNormalEncoding == 2) n = octDecode(texel.xy);
    if (kNormalEncoding == 3) n = octDecode(texel.xy * 2.0 - 1.0);
    float square = dot(n, n);
    return square > 1e-12 ? n * inversesqrt(square) : vec3(0.0, 0.0, 1.0);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(hostDepth, pixel, 0).x;
    bool seen = depth != push.p.farthest;
    outDepth = seen ? max(depth * push.p.depthScale + push.p.depthOffset, 0.0) : 0.0;
    float roughness = 1.0;
#ifdef AG_GLOSSY
    vec3 baseColor = texelFetch(hostBaseColor, pixel, 0).rgb;
    vec4 material = texelFetch(hostMaterial, pixel, 0);
    roughness = material[kRoughnessChannel];
    float metallic = material[kMetallicChannel];
    outAlbedo = vec4(diffuseAlbedo(baseColor, metallic), metallic);
    outReflectance = seen ? vec4(specularF0(baseColor, metallic, 1.0), specularF90(metallic, 1.0)) : vec4(0.0);
#endif
    outNormal = seen ? vec4(decodeNormal(texelFetch(hostNormal, pixel, 0)), roughness) : vec4(0.0);
}
