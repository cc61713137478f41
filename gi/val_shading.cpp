#include "gi/val_shading.h"

#include <algorithm>

#include "gi/pixel_list.h"
#include "shaders/val_shading/val_shading_io.h"

namespace ag::gi {
namespace {

constexpr ValTileNames kGlossTiles = {"val_gloss.classify", "val_gloss.lists", "val_gloss.counts",
                                      "val_gloss.lacking", "val_gloss.lacking_counts"};

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

// A tile's parts are whole squares of 2 x 2 blocks, and whole subgroups of up to 16 blocks. Where pixels are
// left out tiles are smaller, so that no more lights are near to one.
uint32_t tileSizeFor(uint32_t interleave, uint32_t spacing) {
    if (interleave <= 2 && spacing > 1) return interleave == 1 && spacing > 3 ? 8 : 16;
    return interleave == 3 ? 24 : 32;
}

struct Gather {
    GraphScope scope;
    const Surfaces& gbuffer;
    const ShadowedVals& lights;
    io::ValShadingPush push;
    BufferHandle lists, counts, lackingCounts, lacking;
    uint32_t tileCount, blocks;  // blocks of 2 x 2 pixels
    uint32_t interleave;
};

void addClassification(const Gather& g, std::string_view name) {
    g.scope.compute(name, "val_shading/classify_lights.comp")
        .sample("depthMap", g.gbuffer.depth)
        .read("camera", g.gbuffer.camera)
        .read("vals", g.lights.vals.vals)
        .read("shapes", g.lights.vals.shapes)
        .write("lists", g.lists)
        .write("counts", g.counts)
        .write("lackingCounts", g.lackingCounts)
        .push(g.push)
        .dispatchGroups(g.push.tiles.x * g.push.tiles.y);
}

PassBuilder addGather(const Gather& g, std::string_view name, std::string_view shader, ValShape shape,
                      uint32_t taps) {
    PassBuilder pass = g.scope.compute(name, shader);
    pass.sample("normalMap", g.gbuffer.normal)
        .sample("depthMap", g.gbuffer.depth)
        .read("camera", g.gbuffer.camera)
        .read("vals", g.lights.vals.vals)
        .read("shapes", g.lights.vals.shapes)
        .read("isms", g.lights.isms.planes ? g.lights.isms.planes : g.lights.vals.vals)
        .read("lists", g.lists)
        .read("counts", g.counts)
        .spec(0, uint32_t(shape))
        .spec(1, g.lights.isms.planes ? taps : 0)
        .spec(2, g.interleave)
        .spec(3, g.lights.isms.mapping == IsmMapping::kParaboloid)
        .spec(4, g.lights.isms.shared)
        .push(g.push);
    return pass;
}

// With every tile's lights sorted into near and far ones.
Gather addTiles(GraphScope scope, const Surfaces& gbuffer, const ShadowedVals& lights, float nearReach,
                uint32_t interleave, const ValTileNames& names) {
    const uint32_t tileSize = tileSizeFor(interleave, gbuffer.spacing);
    const glm::uvec2 tiles = (gbuffer.size + tileSize - 1u) / tileSize;
    const uint64_t tileCount = uint64_t(tiles.x) * tiles.y;
    const uint64_t lackingCount = interleave > 1 ? tileCount * tileSize * tileSize : 1;
    const Gather g{
        .scope = scope,
        .gbuffer = gbuffer,
        .lights = lights,
        .push = {.valCount = lights.vals.count,
                 .firstVal = lights.vals.first,
                 .tileSize = tileSize,
                 .tiles = tiles,
                 .nearReach = nearReach,
                 .ismTileSize = lights.isms.tileSize},
        .lists = scope.buffer(names.lists, {.sizeBytes = tileCount * io::kLightLists * lights.vals.count * 4,
                                            .texelFormat = VK_FORMAT_R32_UINT}),
        .counts = scope.buffer(names.counts, {.sizeBytes = tileCount * 8}),
        .lackingCounts = scope.buffer(names.lackingCounts, {.sizeBytes = tileCount * 4}),
        .lacking = scope.buffer(names.lacking, {.sizeBytes = lackingCount * 4}),
        .tileCount = uint32_t(tileCount),
        .blocks = uint32_t(tileCount) * tileSize * tileSize / 4,
        .interleave = interleave};
    addClassification(g, names.classify);
    return g;
}

uint32_t groupsOf(const Gather& g) {
    return (g.blocks + 63) / 64;
}

// Of all workgroups those that are gathered anew, or of those that have a specular lobe.
WorkList addGroupsAnew(const Gather& g, const PixelShare& share, const AnewNames& names,
                       const WorkList* glossy) {
    const HistoryBuffer digests =
        g.scope.historyBuffer(names.digests, {.sizeBytes = groupsOf(g) * sizeof(glm::uvec2)});
    if (glossy) g.scope.fill(names.noDigests, digests.current, 0);  // of those without a specular lobe
    const WorkList anew = addWorkList(g.scope, names.list, groupsOf(g), {0, 1, 1});
    PassBuilder pass = g.scope.compute(names.pass, "val_shading/list_groups.comp");
    pass.sample("normalMap", g.gbuffer.normal)
        .sample("depthMap", g.gbuffer.depth)
        .sample("albedoMap", glossy ? g.gbuffer.albedo : g.gbuffer.normal)  // else not looked at
        .sample("reflectanceMap", glossy ? g.gbuffer.reflectance : g.gbuffer.normal)
        .read("glossyGroups", glossy ? glossy->items : g.lists)
        .readPrevious("previousDigests", digests)
        .write("digests", digests.current)
        .write("listed", anew.items)
        .readWrite("groups", anew.groups)
        .spec(0, glossy != nullptr)
        .push(io::ValSharePush{g.push, share.index, share.count});
    if (glossy)
        pass.dispatchIndirect(glossy->groups);
    else
        pass.dispatchThreads(g.blocks);
    return anew;
}

// Workgroups that have a pixel with a specular lobe.
WorkList addGlossyGroups(const Gather& g, ImageHandle gloss) {
    const WorkList glossy = addWorkList(g.scope, kGlossyGroups, groupsOf(g), {0, 1, 1});
    g.scope.compute("val_gloss.list", "val_shading/list_gloss.comp")
        .sample("reflectanceMap", g.gbuffer.reflectance)
        .readWrite("gloss", gloss)
        .write("glossyGroups", glossy.items)
        .readWrite("groups", glossy.groups)
        .push(g.push)
        .dispatchThreads(g.blocks);
    return glossy;
}

struct GlossGather {
    std::string_view name;
    uint32_t list;  // kNearList or kFarList
    ValShape shape;
    uint32_t taps;
};

void addGloss(const Gather& g, const GlossGather& of, const WorkList& groups, ImageHandle gloss) {
    addGather(g, of.name, "val_shading/gather_gloss.comp", of.shape, of.taps)
        .sample("albedoMap", g.gbuffer.albedo)
        .sample("reflectanceMap", g.gbuffer.reflectance)
        .read("listed", groups.items)
        .readWrite("gloss", gloss)
        .spec(5, of.list)
        .dispatchIndirect(groups.groups);
}

}  // namespace

Irradiance addValShading(GraphScope scope, const Surfaces& gbuffer, const ShadowedVals& lights,
                         const ValShadingSettings& settings, const ValShadingNames& names,
                         const PixelShare& share) {
    if (lights.vals.count == 0) return {};
    const uint32_t n = std::clamp(settings.interleave, 1u, 4u);
    const Gather g = addTiles(scope, gbuffer, lights, settings.nearReach, n, names.tiles);
    const ImageInfo info{.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = gbuffer.size};
    const ImageHandle parts = scope.image(names.parts, info);
    // Pixels that take another's light want to know where it comes from if they are turned otherwise.
    const bool directed = gbuffer.spacing > 1 && gbuffer.normalMapped && n == 1;
    const ImageHandle partsToward = directed ? scope.image(names.partsToward, info) : ImageHandle{};
    const Irradiance result{scope.image(names.irradiance, info),
                            directed ? scope.image(names.toward, info) : ImageHandle{}};
    // Compiled out, a binding takes any image of the same class.
    const auto orOther = [&](ImageHandle image, ImageHandle other) { return directed ? image : other; };
    const bool some = share.some && n == 1;
    const WorkList anew = some ? addGroupsAnew(g, share, kPixelsAnew, nullptr) : WorkList{.items = g.lists};
    const auto dispatch = [&](PassBuilder pass) {
        pass.read("listed", anew.items).spec(7, directed).spec(8, some);
        if (some)
            pass.dispatchIndirect(anew.groups);
        else
            pass.dispatchThreads(g.blocks);
    };
    // What is not gathered anew stays.
    dispatch(addGather(g, names.far, "val_shading/gather_far.comp", settings.farShape, settings.farTaps)
                 .readWrite("parts", parts)
                 .readWrite("partsToward", orOther(partsToward, parts)));
    dispatch(addGather(g, names.near, "val_shading/gather_near.comp", settings.shape, settings.taps)
                 .sample("parts", parts)
                 .sample("partsToward", orOther(partsToward, parts))
                 .readWrite("toward", orOther(result.toward, result.image))
                 .readWrite("lackingCounts", g.lackingCounts)
                 .write("lacking", g.lacking)
                 .readWrite("irradiance", result.image));
    if (n > 1)
        addGather(g, names.fill, "val_shading/gather_lacking.comp", settings.farShape, settings.farTaps)
            .read("lackingCounts", g.lackingCounts)
            .read("lacking", g.lacking)
            .readWrite("irradiance", result.image)
            .dispatchGroups(g.tileCount);
    return result;
}

ImageHandle addValGloss(GraphScope scope, const Surfaces& gbuffer, const ShadowedVals& lights,
                        const ValShadingSettings& settings, const PixelShare& share) {
    const bool lightsHaveArea = settings.farShape != ValShape::kPoint;
    if (!settings.glossy || !gbuffer.reflectance || lights.vals.count == 0 || !lightsHaveArea) return {};
    const Gather g = addTiles(scope, gbuffer, lights, settings.nearReach, 1, kGlossTiles);
    const ImageHandle gloss = scope.image("val_gloss.gloss", scope.info(gbuffer.reflectance));
    const WorkList glossy = addGlossyGroups(g, gloss);
    const WorkList anew = share.some ? addGroupsAnew(g, share, kGlossyAnew, &glossy) : glossy;
    addGloss(g, {"val_gloss.near", io::kNearList, settings.shape, settings.taps}, anew, gloss);
    addGloss(g, {"val_gloss.far", io::kFarList, settings.farShape, settings.farTaps}, anew, gloss);
    return gloss;
}

}  // namespace ag::gi
