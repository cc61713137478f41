#include "gi/published/interleaved_shading.h"

#include <algorithm>

namespace ag::gi {
namespace {

// A tile's parts are whole squares of 2 x 2 blocks, and whole subgroups of up to 16 blocks.
uint32_t tileSizeFor(uint32_t side) {
    return side == 3 ? 24 : 32;
}

PassBuilder partsPass(const ValTiles& t, uint32_t side, std::string_view name, std::string_view shader,
                      ValShape shape, uint32_t taps) {
    PassBuilder pass = gatherPass(t, name, shader, shape, taps);
    pass.constant("kSide", side).constant("kSharedMaps", t.lights.isms.shared);
    return pass;
}

}  // namespace

Irradiance addInterleavedShading(GraphScope scope, const Surfaces& gbuffer, const ShadowedVals& lights,
                                 const ValShadingSettings& settings, uint32_t side,
                                 const InterleavedShadingNames& names) {
    if (lights.vals.count == 0) return {};
    const uint32_t n = std::clamp(side, 1u, 4u), tileSize = tileSizeFor(n);
    const ValTiles t = addValTiles(scope, gbuffer, lights, settings.nearReach, tileSize, names.tiles);
    const ImageInfo info{.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = gbuffer.size};
    const ImageHandle parts = scope.image(names.parts, info), result = scope.image(names.irradiance, info);
    const BufferHandle lacking =
        scope.buffer(names.lacking, {.sizeBytes = uint64_t(t.tileCount) * tileSize * tileSize * 4});
    const BufferHandle counts = scope.buffer(names.lackingCounts, {.sizeBytes = t.tileCount * 4ull});
    scope.fill(names.noneLacking, counts, 0);
    partsPass(t, n, names.far, "published/interleaved_shading/gather_far.comp", settings.farShape,
              settings.farTaps)
        .write("parts", parts)
        .dispatchThreads(t.blocks);
    partsPass(t, n, names.near, "published/interleaved_shading/gather_near.comp", settings.shape,
              settings.taps)
        .sample("parts", parts)
        .readWrite("lackingCounts", counts)
        .write("lacking", lacking)
        .write("irradiance", result)
        .dispatchThreads(t.blocks);
    partsPass(t, n, names.fill, "published/interleaved_shading/gather_lacking.comp", settings.farShape,
              settings.farTaps)
        .read("lackingCounts", counts)
        .read("lacking", lacking)
        .readWrite("irradiance", result)
        .dispatchGroups(t.tileCount);
    return {result, {}};
}

}  // namespace ag::gi
