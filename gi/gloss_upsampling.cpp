#include "gi/gloss_upsampling.h"

#include "gi/upsampling.h"
#include "gi/val_tiles.h"

namespace ag::gi {
namespace {

constexpr PixelListNames kAlone = {"val_gloss.alone", "val_gloss.none_alone", "val_gloss.alone_groups",
                                   "val_gloss.no_alone_groups"};

}  // namespace

ImageHandle addGlossUpsampling(GraphScope scope, const Surfaces& all, const Surfaces& cells,
                               ImageHandle gloss, const ShadowedVals& lights, const ValShadingSettings& s) {
    if (cells.spacing == all.spacing) return gloss;
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
        .push(upsamplingPush(all, cells))
        .dispatchThreads(all.size.x, all.size.y);
    PassBuilder pass = scope.compute("val_gloss.gather_alone", "val_shading/gather_gloss_alone.comp");
    readLights(pass, lights, s.shape, s.taps);
    pass.sample("normalMap", all.normal)
        .sample("depthMap", all.depth)
        .sample("albedoMap", all.albedo)
        .sample("reflectanceMap", all.reflectance)
        .read("camera", all.camera)
        .read("alone", alone.pixels)
        .readWrite("result", result)
        .push(glm::uvec3(lights.vals.first, lights.vals.count, lights.isms.tileSize))
        .dispatchIndirect(alone.groups);
    return result;
}

}  // namespace ag::gi
