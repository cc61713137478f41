#include "gi/gloss_upsampling.h"

#include "gi/pixel_list.h"
#include "gi/pixel_rays.h"
#include "shaders/upsampling/upsampling_io.h"

namespace ag::gi {
namespace {

constexpr PixelListNames kAlone = {"val_gloss.alone", "val_gloss.none_alone", "val_gloss.alone_groups",
                                   "val_gloss.no_alone_groups"};

}  // namespace

ImageHandle addGlossUpsampling(GraphScope scope, const Surfaces& all, const Surfaces& cells,
                               ImageHandle gloss, const ShadowedVals& lights, const ValShadingSettings& s) {
    if (cells.spacing == all.spacing) return gloss;
    const uint32_t spacing = cells.spacing / all.spacing;
    const io::PixelRays rays = pixelRays(all.view, all.size);
    const ImageHandle result = scope.image("val_gloss.result", scope.info(all.reflectance));
    const PixelList alone = addPixelList(scope, kAlone, all.size);
    scope.compute("val_gloss.upsample", "val_shading/upsample_gloss.comp")
        .sample("normalMap", all.normal)
        .sample("depthMap", all.depth)
        .sample("cellNormals", cells.normal)
        .sample("cellDepths", cells.depth)
        .sample("reflectanceMap", all.reflectance)
        .sample("cellReflectance", cells.reflectance)
        .sample("cellGloss", gloss)
        .readWrite("listed", alone.pixels)
        .readWrite("listedGroups", alone.groups)
        .write("result", result)
        .push(io::UpsamplingPush{.rays = rays,
                                 .footprint = 2 * float(spacing) * glm::length(rays.down),
                                 .near = all.view.near,
                                 .spacing = spacing})
        .dispatchThreads(all.size.x, all.size.y);
    const Vals& vals = lights.vals;
    const IsmAtlas& isms = lights.isms;
    scope.compute("val_gloss.gather_alone", "val_shading/gather_gloss_alone.comp")
        .sample("normalMap", all.normal)
        .sample("depthMap", all.depth)
        .sample("albedoMap", all.albedo)
        .sample("reflectanceMap", all.reflectance)
        .read("camera", all.camera)
        .read("vals", vals.vals)
        .read("shapes", vals.shapes)
        .read("isms", isms.planes ? isms.planes : vals.vals)
        .read("alone", alone.pixels)
        .readWrite("result", result)
        .constant("kShape", uint32_t(s.shape))
        .constant("kVisibilityTaps", isms.planes ? s.taps : 0)
        .constant("kParaboloid", isms.mapping == IsmMapping::kParaboloid)
        .push(glm::uvec3(vals.first, vals.count, isms.tileSize))
        .dispatchIndirect(alone.groups);
    return result;
}

}  // namespace ag::gi
