#include "gi/rsm.h"

#include <algorithm>

#include "engine/core/hash.h"
#include "gi/pixel_list.h"
#include "gi/rsm_views.h"

namespace ag::gi {
namespace {

constexpr PixelListNames kCreasedTexels = {"rsm.creased", "rsm.none_creased", "rsm.groups", "rsm.no_groups"};

template <class T>
BufferHandle uploadItems(GraphScope scope, const char* name, std::span<const T> items) {
    const BufferHandle buffer =
        scope.buffer(name, {.sizeBytes = items.size_bytes(), .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT});
    scope.upload(name, buffer, std::as_bytes(items));
    return buffer;
}

// Of points on surfaces, not of what lights see.
bool isOfSurfaces(const RsmSet& rsm, uint32_t tile) {
    const uint32_t across = rsm.atlas.size.x / io::kRsmTileSize;
    const glm::uvec2 at = glm::uvec2(tile % across, tile / across) * io::kRsmTileSize;
    for (uint32_t f = rsm.lightFaceCount; f < rsm.atlas.faceCount; ++f) {
        const glm::uvec2 inFace = at - rsm.faceInfo[f].origin;  // left of or above it: huge
        if (inFace.x < rsm.faceInfo[f].size && inFace.y < rsm.faceInfo[f].size) return true;
    }
    return false;
}

// A part for each run of tiles of one kind: while only points change, tiles of lights are not built again.
void addParts(PassBuilder& pass, const RsmSet& rsm, BufferHandle points) {
    for (uint32_t tile = 0, end; tile < rsm.tileCount; tile = end) {
        const bool ofSurfaces = isOfSurfaces(rsm, tile);
        for (end = tile + 1; end < rsm.tileCount && isOfSurfaces(rsm, end) == ofSurfaces;)
            ++end;
        pass.part(tile, end - tile, 0).partReads(rsm.faces).partReads(rsm.maps);
        if (ofSurfaces)
            pass.partReads(points);
        else
            pass.partReads(rsm.normal).partReads(rsm.albedo).partReads(rsm.depth);
    }
}

}  // namespace

void addRsmTexels(GraphScope scope, const RsmSet& rsm, const SurfaceEmitters& emitters) {
    const PixelList creased = addPixelList(scope, kCreasedTexels, rsm.atlas.size);
    const BufferHandle points = emitters.texels ? emitters.texels : rsm.faces;  // none: not read
    struct {
        uint32_t firstTile = 0;
        io::RsmAtlas atlas;
    } push{.atlas = rsm.atlas};
    PassBuilder build = scope.compute("rsm.build_texels", "rsm/build_texels.comp");
    build.sample("normalMap", rsm.normal)
        .sample("albedoMap", rsm.albedo)
        .sample("depthMap", rsm.depth)
        .read("faces", rsm.faces)
        .read("maps", rsm.maps)
        .read("points", points)
        .constant("kHasPoints", bool(emitters.texels))
        .parts("texels", rsm.texels)
        .parts("tileMaps", rsm.tileMaps)
        .readWrite("listed", creased.pixels)
        .readWrite("listedGroups", creased.groups)
        .push(push);
    addParts(build, rsm, points);
    // In place: texels that were not built just now are trimmed already, and not listed.
    scope.compute("rsm.trim_texels", "rsm/trim_texels.comp")
        .read("texels", rsm.texels)
        .read("tileMaps", rsm.tileMaps)
        .read("faces", rsm.faces)
        .read("maps", rsm.maps)
        .read("creased", creased.pixels)
        .readWrite("trimmed", rsm.texels)
        .push(rsm.atlas)
        .dispatchIndirect(creased.groups);
}

void readRsmTexels(PassBuilder& pass, const RsmSet& rsm) {
    pass.read("texels", rsm.texels).read("maps", rsm.maps).read("tileMaps", rsm.tileMaps);
    pass.sample("rsmNormals", rsm.normal).sample("rsmAlbedos", rsm.albedo).constant("kTexelLobes", rsm.lobes);
}

RsmSet planRsm(GraphScope scope, const World& world, const RsmSettings& settings, uint32_t clusterBudget,
               const SurfaceEmitters& emitters, const SunFocus& focus, RsmHistory& history) {
    RsmSet rsm;
    const RsmLayout layout = layoutRsm(world, settings, clusterBudget, history, emitters, focus);
    if (layout.mapCount == 0 || world.bounds.empty()) return rsm;
    rsm.atlas = {.size = layout.atlasSize, .faceCount = layout.faceCount, .mapCount = layout.mapCount};
    rsm.lightRsmCount = layout.lightMapCount;
    rsm.lightFaceCount = layout.lightFaceCount;
    rsm.emissiveCount = layout.emissiveClusters;
    if (emitters.reflecting.side > 0) rsm.firstLater = layout.maps[layout.mapCount - 1].firstCluster;
    rsm.mapInfo = layout.maps;
    rsm.faceInfo = layout.faces;
    rsm.lightIds = layout.lightIds;
    rsm.largestFace = layout.largestFace;
    rsm.tileCount = (layout.atlasSize.x / io::kRsmTileSize) * (layout.atlasSize.y / io::kRsmTileSize);
    const std::span faces(rsm.faceInfo.data(), layout.faceCount);
    const std::span maps(rsm.mapInfo.data(), layout.mapCount);
    rsm.inputsVersion = combineHash(hashBytes(std::as_bytes(faces)), hashBytes(std::as_bytes(maps)));

    rsm.normal =
        scope.image("rsm.normal", {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = layout.atlasSize});
    rsm.albedo =
        scope.image("rsm.albedo", {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = layout.atlasSize});
    rsm.depth = scope.image("rsm.depth", {.format = VK_FORMAT_D32_SFLOAT, .size = layout.atlasSize});

    rsm.faces = uploadItems<io::RsmFace>(scope, "rsm.faces", rsm.faceInfo);
    rsm.maps = uploadItems<io::RsmMap>(scope, "rsm.maps", rsm.mapInfo);
    const uint64_t texelCount = uint64_t(layout.atlasSize.x) * layout.atlasSize.y;
    const BufferInfo texels{.sizeBytes = texelCount * sizeof(io::RsmTexel),
                            .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT};
    rsm.texels = scope.buffer("rsm.texels", texels);
    rsm.tileMaps = scope.buffer("rsm.tile_maps", {.sizeBytes = rsm.tileCount * sizeof(uint32_t)});
    return rsm;
}

}  // namespace ag::gi
