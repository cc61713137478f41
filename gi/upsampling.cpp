#include "gi/upsampling.h"

#include "gi/pixel_rays.h"
#include "shaders/upsampling/upsampling_io.h"

namespace ag::gi {
namespace {

ImageInfo upsampledInfo(const Surfaces& all) {
    return {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = all.size};
}

struct Upsampled {
    Irradiance irradiance;
    PixelList alone;
};

Upsampled addUpsampled(GraphScope scope, const Surfaces& all, const Surfaces& downsampled,
                       const Irradiance& gathered, const UpsamplingNames& names, const Irradiance& base) {
    const io::UpsamplingPush push = upsamplingPush(all, downsampled);
    const ImageHandle result = scope.image(names.irradiance, upsampledInfo(all));
    const PixelList lacking = addPixelList(scope, names.lacking, all.size);
    const PixelList alone = addPixelList(scope, names.alone, all.size);
    const auto addPass = [&](std::string_view name, const char* shader) {
        PassBuilder pass = scope.compute(name, shader);
        pass.sample("normalMap", all.normal)
            .sample("depthMap", all.depth)
            .sample("cellNormals", downsampled.normal)
            .sample("cellDepths", downsampled.depth)
            .sample("light", gathered.image)
            .sample("toward", gathered.toward ? gathered.toward : gathered.image)
            .sample("base", base.image ? base.image : gathered.image)
            .constant("kDirected", bool(gathered.toward))
            .constant("kAdd", bool(base.image))
            .push(push);
        return pass;
    };
    addPass(names.near, "upsampling/upsample.comp")
        .readWrite("listed", lacking.pixels)
        .readWrite("listedGroups", lacking.groups)
        .write("result", result)
        .dispatchThreads(all.size.x, all.size.y);
    PassBuilder far = addPass(names.far, "upsampling/upsample_lacking.comp");
    far.read("lacking", lacking.pixels)
        .readWrite("listed", alone.pixels)
        .readWrite("listedGroups", alone.groups)
        .readWrite("result", result)
        .dispatchIndirect(lacking.groups);
    return {{result, base.toward}, alone};
}

bool isGatheredAtAll(const Surfaces& all, const Surfaces& downsampled, const Irradiance& gathered) {
    return !gathered.image || downsampled.spacing == all.spacing;
}

}  // namespace

io::UpsamplingPush upsamplingPush(const Surfaces& all, const Surfaces& downsampled) {
    const uint32_t spacing = downsampled.spacing / all.spacing;
    const io::PixelRays rays = pixelRays(all.view, all.size);
    return {.rays = rays,
            .footprint = 2 * float(spacing) * glm::length(rays.down),
            .near = all.view.near,
            .spacing = spacing,
            .place = downsampled.place};
}

Irradiance addUpsampling(GraphScope scope, const Surfaces& all, const Surfaces& downsampled,
                         const Irradiance& gathered, const UpsamplingNames& names, const Irradiance& base) {
    if (isGatheredAtAll(all, downsampled, gathered)) return gathered;
    return addUpsampled(scope, all, downsampled, gathered, names, base).irradiance;
}

Irradiance addUpsampling(GraphScope scope, const Surfaces& all, const Surfaces& downsampled,
                         const Irradiance& gathered, const UpsamplingNames& names, const LightsOfPixels& of) {
    if (isGatheredAtAll(all, downsampled, gathered)) return gathered;
    const Upsampled up = addUpsampled(scope, all, downsampled, gathered, names, {});
    const auto& [vals, isms] = of.lights;
    if (!vals.shapes) return up.irradiance;  // samples of RSMs, or points
    PassBuilder pass = scope.compute(names.gather, "upsampling/gather_alone.comp");
    readLights(pass, of.lights, ValShape::kPolygon, of.taps);
    pass.sample("normalMap", all.normal)
        .sample("depthMap", all.depth)
        .read("camera", all.camera)
        .read("alone", up.alone.pixels)
        .readWrite("result", up.irradiance.image)
        .push(glm::uvec3(vals.first, vals.count, isms.tileSize))
        .dispatchIndirect(up.alone.groups);
    return up.irradiance;
}

bool hasAllPixels(GraphScope scope, const UpsamplingNames& names) {
    return scope.wasWanted(names.near) || scope.wasWanted(names.place);
}

Irradiance addPlacing(GraphScope scope, const Surfaces& all, const Surfaces& downsampled,
                      const Irradiance& gathered, const UpsamplingNames& names) {
    if (isGatheredAtAll(all, downsampled, gathered)) return gathered;
    const ImageHandle result = scope.image(names.irradiance, upsampledInfo(all));
    scope.compute(names.place, "upsampling/place.comp")
        .sample("light", gathered.image)
        .readWrite("result", result)
        .push(glm::ivec3(downsampled.place, downsampled.spacing / all.spacing))
        .dispatchThreads(downsampled.size.x, downsampled.size.y);
    return {result, {}};
}

}  // namespace ag::gi
