// A pixel with a specular lobe, and what area lights add to it. Before: gather_inputs.glsl, the constant kList.
#ifndef AG_GLOSSY_PIXEL_GLSL
#define AG_GLOSSY_PIXEL_GLSL

#include "val_shading/gloss.glsl"

layout(set = 0, binding = 8) uniform sampler2D albedoMap;
layout(set = 0, binding = 9) uniform sampler2D reflectanceMap;

struct GlossyPixel {
    Receiver receiver;
    Specular specular;
    bool glossy;
    vec3 radiance;  // sum, W/(m² sr)
};

GlossyPixel glossyPixelAt(ivec2 pixel) {
    float depth = texelFetch(depthMap, pixel, 0).x;
    vec4 normalAndRoughness = texelFetch(normalMap, pixel, 0), reflectance = texelFetch(reflectanceMap, pixel, 0);
    vec3 x = worldFromPixel(camera.camera.worldFromClip, camera.camera.size, pixel, depth);
    GlossyPixel g;
    g.receiver = Receiver(x, normalAndRoughness.xyz, kList == kNearList ? widthOf(pixel, depth) : 0.0, vec3(0.0), vec3(0.0));
    g.specular = specularOf(normalize(camera.camera.position - x), normalAndRoughness.w, reflectance, texelFetch(albedoMap, pixel, 0).rgb);
    g.glossy = depth > 0.0 && any(greaterThan(reflectance, vec4(0.0)));
    g.radiance = vec3(0.0);
    return g;
}

void addGloss(AreaLight l, inout GlossyPixel g) {
    Receiver r = g.receiver;
    vec3 e = irradianceFrom(l, r.position, r.normal, r.width, push.p.ismTileSize);
    g.radiance += specularRadiance(g.specular, r.position, r.normal, l, e);
}
#endif
