#include "gi/ism_atlas.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "engine/core/hash.h"

namespace ag::gi {
namespace {

constexpr uint32_t kCoarsestSize = 4;  // texels along the last level's tile
constexpr uint32_t kMostLevels = 6;
constexpr VkFormat kUint = VK_FORMAT_R32_UINT;

// The graph keeps views of pass names, so they are literals.
constexpr std::array<std::string_view, kMostLevels> kPullNames = {"ism_atlas.pull1", "ism_atlas.pull2",
                                                                  "ism_atlas.pull3", "ism_atlas.pull4",
                                                                  "ism_atlas.pull5", "ism_atlas.pull6"};
constexpr std::array<std::string_view, kMostLevels> kPushNames = {"ism_atlas.push1", "ism_atlas.push2",
                                                                  "ism_atlas.push3", "ism_atlas.push4",
                                                                  "ism_atlas.push5", "ism_atlas.push6"};

void addPullPush(FrameGraph& graph, BufferHandle planes, uint32_t mapCount, uint32_t tileSize) {
    std::array<io::IsmLevelPush, kMostLevels> levels{};
    uint32_t count = 0, fine = 0;
    for (uint32_t size = tileSize / 2; size >= kCoarsestSize; size /= 2) {
        const uint32_t coarse = fine + mapCount * size * size * 4;
        levels[count++] = {size, fine, coarse};
        fine = coarse;
    }
    for (uint32_t i = 0; i < count; ++i)
        graph.compute(kPullNames[i], "ism_atlas/pull_level.comp")
            .readWrite("pyramid", planes)
            .push(levels[i])
            .dispatchGroups((levels[i].coarseSize * levels[i].coarseSize + 63) / 64, mapCount);
    for (uint32_t i = count; i-- > 0;)
        graph.compute(kPushNames[i], "ism_atlas/push_level.comp")
            .readWrite("pyramid", planes)
            .push(levels[i])
            .dispatchGroups(levels[i].coarseSize * levels[i].coarseSize * 4 / 64, mapCount);
}

// What maps are made of and like, as a number; 0: none are kept.
uint32_t contentsOf(const IsmAtlasSettings& s, const IsmAtlas& atlas, const SurfacePoints& points) {
    if (!s.keepMaps) return 0;
    const uint64_t size = hashValue(glm::uvec3(atlas.mapCount, atlas.tileSize, atlas.pointsPerMap));
    const uint64_t like = hashValue(glm::vec3(s.splatScale, float(s.mapping), float(s.nearMore)));
    return uint32_t(combineHash(combineHash(size, like), points.version)) | 1;
}

// What makes a map, kept for those whose light and points have not moved.
struct MapHistories {
    HistoryBuffer places, chosen, keys;
};

void addChoice(FrameGraph& graph, const SurfacePoints& points, const Vals& vals,
               const IsmAtlasSettings& settings, const IsmAtlas& atlas, const MapHistories& kept,
               const io::IsmSplatPush& push) {
    graph.compute("ism_atlas.choose", "ism_atlas/choose_points.comp")
        .read("segments", points.segments)
        .read("vals", vals.vals)
        .readPrevious("previousPlaces", kept.places)
        .readPrevious("previousChosen", kept.chosen)
        .write("places", kept.places.current)
        .write("chosen", kept.chosen.current)
        .write("states", atlas.states)
        .spec(0, settings.nearMore)
        .push(push)
        .dispatchGroups(atlas.mapCount);
    graph.compute("ism_atlas.keep", "ism_atlas/keep_maps.comp")
        .readPrevious("previousKeys", kept.keys)
        .read("states", atlas.states)
        .write("keys", kept.keys.current)
        .push(push)
        .dispatchGroups(atlas.tileSize * atlas.tileSize / 256, atlas.mapCount);
}

}  // namespace

IsmAtlas addIsmAtlas(FrameGraph& graph, const SurfacePoints& points, const Vals& vals,
                     const IsmAtlasSettings& settings) {
    if (!settings.enabled || points.count == 0 || vals.count == 0) return {};
    IsmAtlas atlas{.mapCount = std::min(vals.count, io::kMaxIsms),
                   .tileSize = std::clamp(std::bit_floor(settings.tileSize), 16u, 128u),
                   .mapping = settings.mapping};
    const bool paraboloid = settings.mapping == IsmMapping::kParaboloid;
    const uint32_t perMap = atlas.pointsPerMap = std::min(settings.pointsPerMap, points.count);
    const uint64_t texels = uint64_t(atlas.mapCount) * atlas.tileSize * atlas.tileSize;
    atlas.planes = graph.buffer("ism_atlas.planes", {.sizeBytes = (texels + texels / 3 + 1) * 16,
                                                     .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT});
    const io::IsmSplatPush push{.pointCount = points.count,
                                .segmentCount = points.segmentCount,
                                .tileSize = atlas.tileSize,
                                .pointsPerMap = perMap,
                                .pointRadius = settings.splatScale * points.radius,
                                .inverseExtent = 1 / points.extent,
                                .contents = contentsOf(settings, atlas, points)};
    const MapHistories kept{
        .places =
            graph.historyBuffer("ism_atlas.places", {.sizeBytes = atlas.mapCount * sizeof(io::IsmPlace)}),
        .chosen = graph.historyBuffer("ism_atlas.chosen",
                                      {.sizeBytes = atlas.mapCount * perMap * 4ull, .texelFormat = kUint}),
        .keys = graph.historyBuffer("ism_atlas.keys", {.sizeBytes = texels * 4, .texelFormat = kUint})};
    atlas.chosen = kept.chosen.current;
    atlas.states = graph.buffer("ism_atlas.states", {.sizeBytes = atlas.mapCount * sizeof(io::IsmMapState)});
    addChoice(graph, points, vals, settings, atlas, kept, push);
    graph.compute("ism_atlas.splat", "ism_atlas/splat_points.comp")
        .read("points", points.points)
        .read("vals", vals.vals)
        .read("chosen", atlas.chosen)
        .read("states", atlas.states)
        .readWrite("keys", kept.keys.current)
        .spec(3, paraboloid)
        .push(push)
        .dispatchGroups((perMap + 63) / 64, atlas.mapCount);
    graph.compute("ism_atlas.resolve", "ism_atlas/resolve_planes.comp")
        .read("points", points.points)
        .read("vals", vals.vals)
        .read("keys", kept.keys.current)
        .read("chosen", atlas.chosen)
        .write("planes", atlas.planes)
        .spec(0, settings.planes)
        .push(push)
        .dispatchGroups(atlas.tileSize * atlas.tileSize / 256, atlas.mapCount);
    if (settings.pullPush) addPullPush(graph, atlas.planes, atlas.mapCount, atlas.tileSize);
    return atlas;
}

}  // namespace ag::gi
