#include "gi/val_shading.h"

#include "gi/gloss_upsampling.h"
#include "gi/pixel_list.h"
#include "shaders/val_shading/val_shading_io.h"

namespace ag::gi {
namespace {

constexpr ValTileNames kGlossTiles = {"val_gloss.classify", "val_gloss.lists", "val_gloss.counts"};

struct AnewNames {
    std::string_view pass, digests, noDigests;
    WorkListNames list;
};
constexpr AnewNames kPixelsAnew = {"val_shading.list",
                                   "val_shading.digests",
                                   "",
                                   {"val_shading.anew", "val_shading.groups", "val_shading.none"}};
constexpr AnewNames kGlossyAnew = {"val_gloss.list_anew",
                                   "val_gloss.digests",
                                   "val_gloss.no_digests",
                                   {"val_gloss.anew", "val_gloss.anew_groups", "val_gloss.none_anew"}};
constexpr WorkListNames kGlossyGroups = {"val_gloss.glossy", "val_gloss.groups", "val_gloss.none"};

// Where pixels are left out tiles are smaller, so that no more lights are near to one.
uint32_t tileSizeFor(uint32_t spacing) {
    if (spacing == 1) return 32;
    return spacing > 3 ? 8 : 16;
}

uint32_t groupsOf(const ValTiles& t) {
    return (t.blocks + 63) / 64;
}

// Of all workgroups those that are gathered anew, or of those that have a specular lobe.
WorkList addGroupsAnew(const ValTiles& t, const PixelShare& share, const AnewNames& names,
                       const WorkList* glossy) {
    const HistoryBuffer digests =
        t.scope.historyBuffer(names.digests, {.sizeBytes = groupsOf(t) * sizeof(glm::uvec2)});
    if (glossy) t.scope.fill(names.noDigests, digests.current, 0);  // of those without a specular lobe
    const WorkList anew = addWorkList(t.scope, names.list, groupsOf(t), {0, 1, 1});
    PassBuilder pass = t.scope.compute(names.pass, "val_shading/list_groups.comp");
    pass.sample("normalMap", t.gbuffer.normal)
        .sample("depthMap", t.gbuffer.depth)
        .sample("albedoMap", glossy ? t.gbuffer.albedo : t.gbuffer.normal)  // else not looked at
        .sample("reflectanceMap", glossy ? t.gbuffer.reflectance : t.gbuffer.normal)
        .read("glossyGroups", glossy ? glossy->items : t.lists)
        .readPrevious("previousDigests", digests)
        .write("digests", digests.current)
        .write("listed", anew.items)
        .readWrite("groups", anew.groups)
        .constant("kGlossy", glossy != nullptr)
        .push(io::ValSharePush{t.push, share.index, share.count});
    if (glossy)
        pass.dispatchIndirect(glossy->groups);
    else
        pass.dispatchThreads(t.blocks);
    return anew;
}

// Workgroups that have a pixel with a specular lobe.
WorkList addGlossyGroups(const ValTiles& t, ImageHandle gloss) {
    const WorkList glossy = addWorkList(t.scope, kGlossyGroups, groupsOf(t), {0, 1, 1});
    t.scope.compute("val_gloss.list", "val_shading/list_gloss.comp")
        .sample("reflectanceMap", t.gbuffer.reflectance)
        .readWrite("gloss", gloss)
        .write("glossyGroups", glossy.items)
        .readWrite("groups", glossy.groups)
        .push(t.push)
        .dispatchThreads(t.blocks);
    return glossy;
}

Surfaces withMaterials(GraphScope scope, const Surfaces& all, const Surfaces& downsampled) {
    const uint32_t spacing = downsampled.spacing / all.spacing;
    Surfaces cells = downsampled;
    cells.albedo = addDownsampledImage(scope, "val_gloss.downsample_albedo", all.albedo, spacing);
    cells.reflectance =
        addDownsampledImage(scope, "val_gloss.downsample_reflectance", all.reflectance, spacing);
    return cells;
}

void addGloss(const ValTiles& t, const GlossGather& of, const WorkList& groups, ImageHandle gloss) {
    gatherPass(t, of.name, "val_shading/gather_gloss.comp", of.shape, of.taps)
        .sample("albedoMap", t.gbuffer.albedo)
        .sample("reflectanceMap", t.gbuffer.reflectance)
        .read("listed", groups.items)
        .readWrite("gloss", gloss)
        .constant("kList", of.list)
        .dispatchIndirect(groups.groups);
}

}  // namespace

ValTiles addShadingTiles(GraphScope scope, const Surfaces& gbuffer, const ShadowedVals& lights,
                         const ValShadingSettings& settings, const ValShadingNames& names) {
    if (lights.vals.empty()) return {.scope = scope, .gbuffer = gbuffer, .lights = lights};
    return addValTiles(scope, gbuffer, lights, settings.nearReach, tileSizeFor(gbuffer.spacing), names.tiles);
}

Irradiance addValShading(GraphScope scope, const Surfaces& gbuffer, const ShadowedVals& lights,
                         const ValShadingSettings& settings, const ValShadingNames& names) {
    return addValShading(addShadingTiles(scope, gbuffer, lights, settings, names), settings, names);
}

Irradiance addValShading(const ValTiles& t, const ValShadingSettings& settings, const ValShadingNames& names,
                         const PixelShare& share) {
    if (t.tileCount == 0) return {};
    const GraphScope scope = t.scope;
    const Surfaces& gbuffer = t.gbuffer;
    const ImageInfo info{.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = gbuffer.size};
    const ImageHandle far = scope.image(names.farIrradiance, info);
    // Pixels that take another's light want to know where it comes from if they are turned otherwise.
    const bool directed = gbuffer.spacing > 1 && gbuffer.normalMapped;
    const ImageHandle farToward = directed ? scope.image(names.farToward, info) : ImageHandle{};
    const Irradiance result{scope.image(names.irradiance, info),
                            directed ? scope.image(names.toward, info) : ImageHandle{}};
    // Compiled out, a binding takes any image of the same class.
    const auto orOther = [&](ImageHandle image, ImageHandle other) { return directed ? image : other; };
    const WorkList anew =
        share.some ? addGroupsAnew(t, share, kPixelsAnew, nullptr) : WorkList{.items = t.lists};
    const auto dispatch = [&](PassBuilder pass) {
        pass.read("listed", anew.items).constant("kDirected", directed).constant("kListed", share.some);
        if (share.some)
            pass.dispatchIndirect(anew.groups);
        else
            pass.dispatchThreads(t.blocks);
    };
    // What is not gathered anew stays.
    dispatch(gatherPass(t, names.far, "val_shading/gather_far.comp", settings.farShape, settings.farTaps)
                 .readWrite("far", far)
                 .readWrite("farToward", orOther(farToward, far)));
    dispatch(gatherPass(t, names.near, "val_shading/gather_near.comp", settings.shape, settings.taps)
                 .sample("far", far)
                 .sample("farToward", orOther(farToward, far))
                 .readWrite("toward", orOther(result.toward, result.image))
                 .readWrite("irradiance", result.image));
    return result;
}

ImageHandle addValGloss(GraphScope scope, const Surfaces& all, const Surfaces& downsampled,
                        const ShadowedVals& lights, const ValShadingSettings& settings,
                        const PixelShare& share) {
    const bool lightsHaveArea = settings.farShape != ValShape::kPoint;
    if (!settings.glossy || !all.reflectance || lights.vals.count == 0 || !lightsHaveArea) return {};
    const Surfaces cells = withMaterials(scope, all, downsampled);
    const ValTiles t =
        addValTiles(scope, cells, lights, settings.nearReach, tileSizeFor(cells.spacing), kGlossTiles);
    const ImageHandle gloss = scope.image("val_gloss.gloss", scope.info(cells.reflectance));
    const WorkList glossy = addGlossyGroups(t, gloss);
    const WorkList anew = share.some ? addGroupsAnew(t, share, kGlossyAnew, &glossy) : glossy;
    addGloss(t, {"val_gloss.near", io::kNearList, settings.shape, settings.taps}, anew, gloss);
    addGloss(t, {"val_gloss.far", io::kFarList, settings.farShape, settings.farTaps}, anew, gloss);
    return addGlossUpsampling(all, t, gloss, settings);
}

}  // namespace ag::gi
