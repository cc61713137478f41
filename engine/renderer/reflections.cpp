#include "engine/renderer/reflections.h"

#include "gi/blue_noise.h"
#include "gi/pixel_list.h"
#include "gi/pixel_rays.h"
#include "shaders/reflections/reflections_io.h"

namespace ag::render {
namespace {

constexpr gi::PixelListNames kSmooth = {"reflections.smooth", "reflections.none_smooth", "reflections.groups",
                                        "reflections.no_groups"};

gi::PixelList addSmoothPixels(GraphScope scope, const gi::Surfaces& surfaces, float roughness) {
    const gi::PixelList list = gi::addPixelList(scope, kSmooth, surfaces.size);
    scope.compute("reflections.list", "reflections/list_smooth.comp")
        .sample("normalMap", surfaces.normal)
        .sample("depthMap", surfaces.depth)
        .sample("reflectanceMap", surfaces.reflectance)
        .readWrite("listed", list.pixels)
        .readWrite("listedGroups", list.groups)
        .push(roughness)
        .dispatchThreads(surfaces.size.x, surfaces.size.y);
    return list;
}

// What was found, and what part of each pixel's lobe that is.
ImageHandle addMarch(GraphScope scope, const gi::Surfaces& surfaces, ImageHandle radiance,
                     const ReflectionSettings& s) {
    const gi::PixelList list = addSmoothPixels(scope, surfaces, s.roughness);
    const ImageHandle found = scope.image("reflections.found", scope.info(radiance));
    const BufferHandle noise = gi::addBlueNoise(scope);
    scope.compute("reflections.march", "reflections/march.comp")
        .sample("normalMap", surfaces.normal)
        .sample("depthMap", surfaces.depth)
        .sample("reflectanceMap", surfaces.reflectance)
        .sample("radianceMap", radiance, Sampler::kLinearClamp)
        .read("camera", surfaces.camera)
        .read("noise", noise)
        .read("listed", list.pixels)
        .write("found", found)
        .push(io::ReflectionsMarchPush{s.rays, s.steps, s.thickness})
        .dispatchIndirect(list.groups);
    return found;
}

}  // namespace

ImageHandle addReflections(GraphScope scope, const SceneView& scene, const GBuffer& gbuffer,
                           const gi::BounceLight& bounce, ImageHandle radiance, const ReflectionSettings& s) {
    const gi::Surfaces& surfaces = gbuffer.surfaces;
    if (!s.enabled || !surfaces.reflectance || scene.leastRoughness >= s.roughness) return radiance;
    const ImageHandle found = addMarch(scope, surfaces, radiance, s);
    const ImageHandle result = scope.image("reflections.radiance", scope.info(radiance));
    const io::PixelRays rays = gi::pixelRays(surfaces.view, surfaces.size);
    const ImageHandle indirect = bounce.irradiance.image;
    scope.fullscreen("reflections.mix", "reflections/mix.frag")
        .sample("normalMap", surfaces.normal)
        .sample("depthMap", surfaces.depth)
        .sample("reflectanceMap", surfaces.reflectance)
        .sample("radianceMap", radiance)
        .sample("foundMap", found)
        .sample("albedoMap", surfaces.albedo)
        .sample("indirectMap", indirect ? indirect : surfaces.albedo)  // compiled out
        .sample("glossMap", bounce.gloss ? bounce.gloss : surfaces.albedo)
        .constant("kIndirect", bool(indirect))
        .constant("kGloss", bool(bounce.gloss))
        .push(io::ReflectionsMixPush{rays, s.roughness, glm::length(rays.down)})
        .colorClear(result, glm::vec4(0));
    return result;
}

}  // namespace ag::render
