#include "gi/val_tiles.h"

namespace ag::gi {

ValTiles addValTiles(GraphScope scope, const Surfaces& gbuffer, const ShadowedVals& lights, float nearReach,
                     uint32_t tileSize, const ValTileNames& names) {
    const glm::uvec2 tiles = (gbuffer.size + tileSize - 1u) / tileSize;
    const uint64_t tileCount = uint64_t(tiles.x) * tiles.y;
    const ValTiles t{
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
        .tileCount = uint32_t(tileCount),
        .blocks = uint32_t(tileCount) * tileSize * tileSize / 4};
    scope.compute(names.classify, "val_shading/classify_lights.comp")
        .sample("depthMap", gbuffer.depth)
        .read("camera", gbuffer.camera)
        .read("vals", lights.vals.vals)
        .read("shapes", lights.vals.shapes)
        .write("lists", t.lists)
        .write("counts", t.counts)
        .push(t.push)
        .dispatchGroups(t.tileCount);
    return t;
}

void readLights(PassBuilder& pass, const ShadowedVals& lights, ValShape shape, uint32_t taps) {
    const auto& [vals, isms] = lights;
    pass.read("vals", vals.vals)
        .read("shapes", vals.shapes)
        .read("isms", isms.planes ? isms.planes : vals.vals)
        .constant("kShape", uint32_t(shape))
        .constant("kVisibilityTaps", isms.planes ? taps : 0)
        .constant("kParaboloid", isms.mapping == IsmMapping::kParaboloid);
}

PassBuilder gatherPass(const ValTiles& t, std::string_view name, std::string_view shader, ValShape shape,
                       uint32_t taps) {
    PassBuilder pass = t.scope.compute(name, shader);
    readLights(pass, t.lights, shape, taps);
    pass.sample("normalMap", t.gbuffer.normal)
        .sample("depthMap", t.gbuffer.depth)
        .read("camera", t.gbuffer.camera)
        .read("lists", t.lists)
        .read("counts", t.counts)
        .push(t.push);
    return pass;
}

}  // namespace ag::gi
