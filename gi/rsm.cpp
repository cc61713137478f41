#include "gi/rsm.h"

#include <algorithm>

#include "engine/core/hash.h"
#include "gi/pixel_list.h"
#include "gi/rsm_views.h"
#include "gi/scene_draws.h"

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

void addRaster(GraphScope scope, const SceneView& scene, RsmSet& rsm) {
    PassBuilder pass = scope.raster("rsm.render", "gbuffer/fill.vert", "rsm/render.frag",
                                    gpu::VertexLayout::kPositionsAndAttributes);
    pass.colorClear(rsm.normal, glm::vec4(0)).colorClear(rsm.albedo, glm::vec4(0)).depthClear(rsm.depth);
    pass.geometry(scene.geometry).read("instances", scene.instances);
    bindMaterials(pass, scene);
    const uint32_t slot = scene.slots.firstLightMap;
    std::array<ViewRequest, io::kMaxRsmFaces> views;
    for (uint32_t f = 0; f < rsm.lightFaceCount; ++f)
        views[f] = {slot + f, rsm.faceInfo[f].clipFromWorld};
    scene.draws->cullAll(*scene.scene, {views.data(), rsm.lightFaceCount});
    for (uint32_t f = 0; f < rsm.lightFaceCount; ++f) {
        const io::RsmFace& face = rsm.faceInfo[f];
        const ViewDraws& draws = scene.draws->cull(*scene.scene, slot + f, face.clipFromWorld);
        rsm.inputsVersion = combineHash(rsm.inputsVersion, draws.version);
        drawView(pass, scene, draws, face.clipFromWorld, {face.origin, face.size, face.size},
                 DrawFilter::kAll, Viewer::kLight);
    }
}

void addTexels(GraphScope scope, const RsmSet& rsm, const LaterLight& later) {
    const PixelList creased = addPixelList(scope, kCreasedTexels, rsm.atlas.size);
    scope.compute("rsm.build_texels", "rsm/build_texels.comp")
        .sample("normalMap", rsm.normal)
        .sample("albedoMap", rsm.albedo)
        .sample("depthMap", rsm.depth)
        .read("faces", rsm.faces)
        .read("maps", rsm.maps)
        .read("later", later.texels ? later.texels : rsm.faces)  // none: not read
        .spec(0, bool(later.texels))
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

}  // namespace

RsmSet addRsm(GraphScope scope, const SceneView& scene, const RsmSettings& settings, uint32_t clusterBudget,
              const LaterLight& later, ClusterShares& shares) {
    RsmSet rsm;
    const RsmLayout layout =
        layoutRsm(*scene.scene, settings, clusterBudget, shares, later.side, later.share);
    if (layout.mapCount == 0 || scene.scene->instances.empty()) return rsm;
    rsm.atlas = {.size = layout.atlasSize, .faceCount = layout.faceCount, .mapCount = layout.mapCount};
    rsm.lightMapCount = layout.mapCount - (later.side > 0);
    rsm.lightFaceCount = layout.faceCount - (later.side > 0);
    rsm.mapInfo = layout.maps;
    rsm.faceInfo = layout.faces;
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
    addRaster(scope, scene, rsm);

    rsm.faces = uploadItems<io::RsmFace>(scope, "rsm.faces", rsm.faceInfo);
    rsm.maps = uploadItems<io::RsmMap>(scope, "rsm.maps", rsm.mapInfo);
    const uint64_t texelCount = uint64_t(layout.atlasSize.x) * layout.atlasSize.y;
    const BufferInfo texels{.sizeBytes = texelCount * sizeof(io::RsmTexel),
                            .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT};
    rsm.texels = scope.buffer("rsm.texels", texels);
    rsm.tileMaps = scope.buffer("rsm.tile_maps", {.sizeBytes = rsm.tileCount * sizeof(uint32_t)});
    addTexels(scope, rsm, later);
    return rsm;
}

}  // namespace ag::gi
