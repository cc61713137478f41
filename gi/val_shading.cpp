#include "gi/val_shading.h"

#include <algorithm>

#include "shaders/val_shading/val_shading_io.h"

namespace ag::gi {
namespace {

// A tile's parts are whole squares of 2 x 2 blocks, and whole subgroups of up to 16 blocks. Where pixels are
// left out tiles are smaller, so that no more lights are near to one.
uint32_t tileSizeFor(uint32_t interleave, uint32_t spacing) {
    if (interleave <= 2 && spacing > 1) return 16;
    return interleave == 3 ? 24 : 32;
}

struct Gather {
    FrameGraph& graph;
    const GBuffer& gbuffer;
    const Vals& vals;
    const IsmAtlas& isms;
    io::ValShadingPush push;
    BufferHandle lists, counts, lackingCounts, lacking;
    uint32_t interleave;
};

void addClassification(const Gather& g, std::string_view name) {
    g.graph.compute(name, "val_shading/classify_lights.comp")
        .sample("depthMap", g.gbuffer.depth)
        .read("camera", g.gbuffer.camera)
        .read("vals", g.vals.vals)
        .read("shapes", g.vals.shapes)
        .write("lists", g.lists)
        .write("counts", g.counts)
        .write("lackingCounts", g.lackingCounts)
        .push(g.push)
        .dispatchGroups(g.push.tiles.x * g.push.tiles.y);
}

PassBuilder addGather(const Gather& g, std::string_view name, std::string_view shader, ValShape shape,
                      uint32_t taps) {
    PassBuilder pass = g.graph.compute(name, shader);
    pass.sample("normalMap", g.gbuffer.normal)
        .sample("depthMap", g.gbuffer.depth)
        .read("camera", g.gbuffer.camera)
        .read("vals", g.vals.vals)
        .read("shapes", g.vals.shapes)
        .read("isms", g.isms.planes ? g.isms.planes : g.vals.vals)
        .read("lists", g.lists)
        .read("counts", g.counts)
        .spec(0, uint32_t(shape))
        .spec(1, g.isms.planes ? taps : 0)
        .spec(2, g.interleave)
        .spec(3, g.isms.mapping == IsmMapping::kParaboloid)
        .spec(4, g.isms.shared)
        .push(g.push);
    return pass;
}

PassBuilder& bindCoat(PassBuilder& pass, const GBuffer& gbuffer) {
    return pass.sample("albedoMap", gbuffer.albedo).sample("reflectanceMap", gbuffer.reflectance);
}

}  // namespace

bool shadesGloss(const GBuffer& gbuffer, const ValShadingSettings& settings) {
    return settings.glossy && gbuffer.reflectance && settings.farShape != ValShape::kPoint;
}

Irradiance addValShading(FrameGraph& graph, const GBuffer& gbuffer, const Vals& vals, const IsmAtlas& isms,
                         const ValShadingSettings& settings, const ValShadingNames& names) {
    if (vals.count == 0) return {};
    const bool glossy = shadesGloss(gbuffer, settings);
    // What a neighbour's coat reflects is no part of what this pixel's does: other normal, other material.
    const uint32_t n = glossy ? 1 : std::clamp(settings.interleave, 1u, 4u),
                   tileSize = tileSizeFor(n, gbuffer.spacing);
    const glm::uvec2 tiles = (gbuffer.size + tileSize - 1u) / tileSize;
    const uint64_t tileCount = uint64_t(tiles.x) * tiles.y;
    const Gather g{
        .graph = graph,
        .gbuffer = gbuffer,
        .vals = vals,
        .isms = isms,
        .push = {.valCount = vals.count,
                 .tileSize = tileSize,
                 .tiles = tiles,
                 .nearReach = settings.nearReach,
                 .ismTileSize = isms.tileSize},
        .lists = graph.buffer(names.lists, {.sizeBytes = tileCount * io::kLightLists * vals.count * 4,
                                            .texelFormat = VK_FORMAT_R32_UINT}),
        .counts = graph.buffer(names.counts, {.sizeBytes = tileCount * 8}),
        .lackingCounts = graph.buffer(names.lackingCounts, {.sizeBytes = tileCount * 4}),
        .lacking = graph.buffer(names.lacking,
                                {.sizeBytes = n > 1 ? uint64_t(tileCount) * tileSize * tileSize * 4 : 4}),
        .interleave = n};
    const ImageInfo info{.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = gbuffer.size};
    const ImageHandle parts = graph.image(names.parts, info);
    Irradiance result{graph.image(names.irradiance, info)};
    addClassification(g, names.classify);
    const uint32_t blocks = uint32_t(tileCount) * tileSize * tileSize / 4;
    const ImageHandle farCoat = glossy ? graph.image(names.farCoat, info) : ImageHandle{};
    if (glossy) result.coat = graph.image(names.coat, info);
    PassBuilder far =
        addGather(g, names.far, glossy ? "val_shading/gather_far_glossy.comp" : "val_shading/gather_far.comp",
                  settings.farShape, settings.farTaps);
    far.write("parts", parts).dispatchThreads(blocks);
    if (glossy) bindCoat(far, gbuffer).write("farCoat", farCoat);
    PassBuilder near = addGather(
        g, names.near, glossy ? "val_shading/gather_near_glossy.comp" : "val_shading/gather_near.comp",
        settings.shape, settings.taps);
    near.sample("parts", parts).write("irradiance", result.image).dispatchThreads(blocks);
    if (glossy)
        bindCoat(near, gbuffer).sample("farCoat", farCoat).write("coat", result.coat);
    else
        near.readWrite("lackingCounts", g.lackingCounts).write("lacking", g.lacking);
    if (n > 1)
        addGather(g, names.fill, "val_shading/gather_lacking.comp", settings.farShape, settings.farTaps)
            .read("lackingCounts", g.lackingCounts)
            .read("lacking", g.lacking)
            .readWrite("irradiance", result.image)
            .dispatchGroups(uint32_t(tileCount));
    return result;
}

}  // namespace ag::gi
