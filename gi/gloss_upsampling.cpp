#include "gi/gloss_upsampling.h"

#include "gi/upsampling.h"
#include "gi/val_tiles.h"

namespace ag::gi {
namespace {

constexpr PixelListNames kAlone = {"val_gloss.alone", "val_gloss.none_alone", "val_gloss.alone_groups",
                                   "val_gloss.no_alone_groups"};

// Of the lights of one list.
void addAlone(const Surfaces& all, const ValTiles& t, const PixelList& alone, const GlossGather& of,
              ImageHandle result) {
    PassBuilder pass = t.scope.compute(of.name, "val_shading/gather_gloss_alone.comp");
    readLights(pass, t.lights, of.shape, of.taps);
    pass.sample("normalMap", all.normal)
        .sample("depthMap", all.depth)
        .sample("albedoMap", all.albedo)
        .sample("reflectanceMap", all.reflectance)
        .read("camera", all.camera)
        .read("lists", t.lists)
        .read("counts", t.counts)
        .read("alone", alone.pixels)
        .readWrite("result", result)
        .constant("kList", of.list)
        .constant("kSpacing", t.gbuffer.spacing / all.spacing)
        .push(t.push)
        .dispatchIndirect(alone.groups);
}

}  // namespace

ImageHandle addGlossUpsampling(const Surfaces& all, const ValTiles& tiles, ImageHandle gloss,
                               const ValShadingSettings& s) {
    const Surfaces& cells = tiles.gbuffer;
    if (cells.spacing == all.spacing) return gloss;
    const GraphScope scope = tiles.scope;
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
    addAlone(all, tiles, alone, {"val_gloss.near_alone", io::kNearList, s.shape, s.taps}, result);
    addAlone(all, tiles, alone, {"val_gloss.far_alone", io::kFarList, s.farShape, s.farTaps}, result);
    return result;
}

}  // namespace ag::gi
