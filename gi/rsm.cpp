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

}  // namespace

void addRsmTexels(GraphScope scope, const RsmSet& rsm, const SurfaceEmitters& emitters) {
    const PixelList creased = addPixelList(scope, kCreasedTexels, rsm.atlas.size);
    scope.compute("rsm.build_texels", "rsm/build_texels.comp")
        .sample("normalMap", rsm.normal)
        .sample("albedoMap", rsm.albedo)
        .sample("depthMap", rsm.depth)
        .read("faces", rsm.faces)
        .read("maps", rsm.maps)
        .read("points", emitters.texels ? emitters.texels : rsm.faces)  // none: not read
        .constant("kHasPoints", bool(emitters.texels))
        .write("texels", rsm.texels)
        .write("tileMaps", rsm.tileMaps)
        .readWrite("listed", creased.pixels)
        .readWrite("listedGroups", creased.groups)
        .push(rsm.atlas)
        .dispatchGroups(rsm.tileCount);
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
