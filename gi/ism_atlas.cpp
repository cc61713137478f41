#include "gi/ism_atlas.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/hash.h"
#include "gi/pixel_list.h"

namespace ag::gi {
namespace {

constexpr uint32_t kCoarsestSize = 4;  // texels along the last level's tile
constexpr uint32_t kMostLevels = 6;
constexpr uint32_t kTileSizeStep = 16;  // tiles are whole workgroups, and each level half the one before
constexpr VkFormat kUint = VK_FORMAT_R32_UINT;

constexpr WorkListNames kMapsAnew = {"ism_atlas.anew", "ism_atlas.anew_groups", "ism_atlas.none_anew"};

// The graph keeps views of pass names, so they are literals.
constexpr std::array<std::string_view, kMostLevels> kPullNames = {"ism_atlas.close", "ism_atlas.pull2",
                                                                  "ism_atlas.pull3", "ism_atlas.pull4",
                                                                  "ism_atlas.pull5", "ism_atlas.pull6"};
constexpr std::array<std::string_view, kMostLevels> kPushNames = {"ism_atlas.push1", "ism_atlas.push2",
                                                                  "ism_atlas.push3", "ism_atlas.push4",
                                                                  "ism_atlas.push5", "ism_atlas.push6"};

// Holes in planes are closed first, then empty texels are filled from coarser levels.
void addPullPush(FrameGraph& graph, BufferHandle resolved, const IsmAtlas& atlas) {
    const uint32_t mapCount = atlas.mapCount, tileSize = atlas.tileSize;
    std::array<io::IsmLevelPush, kMostLevels> levels{};
    uint32_t count = 0, fine = 0;
    for (uint32_t size = tileSize / 2; size >= kCoarsestSize; size /= 2) {
        const uint32_t coarse = fine + mapCount * size * size * 4;
        levels[count++] = {size, fine, coarse};
        fine = coarse;
    }
    graph.compute(kPullNames[0], "ism_atlas/close_holes.comp")
        .read("resolved", resolved)
        .write("pyramid", atlas.planes)
        .spec(3, atlas.mapping == IsmMapping::kParaboloid)
        .push(levels[0])
        .dispatchGroups((levels[0].coarseSize * levels[0].coarseSize + 63) / 64, mapCount);
    for (uint32_t i = 1; i < count; ++i)
        graph.compute(kPullNames[i], "ism_atlas/pull_level.comp")
            .readWrite("pyramid", atlas.planes)
            .push(levels[i])
            .dispatchGroups((levels[i].coarseSize * levels[i].coarseSize + 63) / 64, mapCount);
    for (uint32_t i = count; i-- > 0;)
        graph.compute(kPushNames[i], "ism_atlas/push_level.comp")
            .readWrite("pyramid", atlas.planes)
            .push(levels[i])
            .dispatchGroups((levels[i].coarseSize * levels[i].coarseSize + 63) / 64, mapCount);
}

// What still layers are made of and like, as a number; 0: none are kept.
uint32_t contentsOf(const IsmAtlasSettings& s, const IsmAtlas& atlas, const SurfacePoints& points,
                    uint32_t stillEntries) {
    if (!s.keepMaps) return 0;
    const uint64_t size =
        hashValue(glm::uvec4(atlas.mapCount, atlas.tileSize, atlas.pointsPerMap, stillEntries));
    const uint64_t like =
        hashValue(glm::vec4(s.splatScale, float(s.mapping), float(s.nearMore), points.extent));
    return uint32_t(combineHash(combineHash(size, like), points.stillVersion)) | 1;
}

// What makes the still layer of a map, kept for those whose light and points have not moved.
struct MapHistories {
    HistoryBuffer places, chosen, keys;
};

// How many of a map's points movable surfaces get: their share of the area within bounds, as what moves is
// looked at.
uint32_t movingEntries(const SurfacePoints& points, uint32_t pointsPerMap) {
    if (points.moving.count == 0) return 0;
    if (points.still.count == 0) return pointsPerMap;
    const float share = float(points.moving.count) / float(points.count);
    const float wanted = std::clamp(share, 0.125f, 0.5f) * float(pointsPerMap);
    return std::min({uint32_t(wanted), points.moving.count, pointsPerMap - 1});
}

io::IsmSplatPush layerPush(io::IsmSplatPush push, const PointLayer& layer, uint32_t firstEntry,
                           uint32_t entryCount, float splatScale) {
    push.firstSegment = layer.firstSegment;
    push.endSegment = layer.firstSegment + layer.segmentCount;
    push.firstEntry = firstEntry;
    push.entryCount = entryCount;
    push.diskRadius = splatScale;
    return push;
}

struct Splat {
    FrameGraph& graph;
    const SurfacePoints& points;
    const Vals& vals;
    const IsmAtlasSettings& settings;
    const IsmAtlas& atlas;
    uint32_t texelGroups() const { return atlas.tileSize * atlas.tileSize / 256; }
};

uint32_t splatGroups(const io::IsmSplatPush& push) {
    return (push.entryCount + 63) / 64;
}

PassBuilder addSplat(const Splat& s, std::string_view name, BufferHandle states, BufferHandle keys,
                     const io::IsmSplatPush& push) {
    PassBuilder pass = s.graph.compute(name, "ism_atlas/splat_points.comp");
    pass.read("points", s.points.points)
        .read("vals", s.vals.vals)
        .read("chosen", s.atlas.chosen)
        .read("states", states)
        .readWrite("keys", keys)
        .spec(3, s.settings.mapping == IsmMapping::kParaboloid)
        .push(push);
    return pass;
}

// All that stands still: maps are kept where neither it nor the light has moved; a splat of those would cost
// its workgroups all the same, so the others are listed.
void addStillLayer(const Splat& s, const MapHistories& kept, const io::IsmSplatPush& push) {
    const WorkList anew = addWorkList(s.graph, kMapsAnew, s.atlas.mapCount, {splatGroups(push), 0, 1});
    s.graph.compute("ism_atlas.choose", "ism_atlas/choose_still.comp")
        .read("segments", s.points.segments)
        .read("vals", s.vals.vals)
        .readPrevious("previousPlaces", kept.places)
        .readPrevious("previousChosen", kept.chosen)
        .write("places", kept.places.current)
        .write("chosen", kept.chosen.current)
        .write("states", s.atlas.states)
        .write("anew", anew.items)
        .readWrite("anewGroups", anew.groups)
        .spec(0, s.settings.nearMore)
        .push(push)
        .dispatchGroups(s.atlas.mapCount);
    s.graph.compute("ism_atlas.keep", "ism_atlas/keep_maps.comp")
        .readPrevious("previousKeys", kept.keys)
        .read("states", s.atlas.states)
        .write("keys", kept.keys.current)
        .push(push)
        .dispatchGroups(s.texelGroups(), s.atlas.mapCount);
    addSplat(s, "ism_atlas.splat", s.atlas.states, kept.keys.current, push)
        .read("listed", anew.items)
        .spec(4, true)
        .dispatchIndirect(anew.groups);
}

// What may move, over a copy of that; every map anew.
BufferHandle addMovingLayer(const Splat& s, BufferHandle stillKeys, const io::IsmSplatPush& push) {
    const BufferHandle states =
        s.graph.buffer("ism_atlas.moving_states", {.sizeBytes = s.atlas.mapCount * sizeof(io::IsmMapState)});
    const uint64_t texels = uint64_t(s.atlas.mapCount) * s.atlas.tileSize * s.atlas.tileSize;
    const BufferHandle keys =
        s.graph.buffer("ism_atlas.all_keys", {.sizeBytes = texels * 4, .texelFormat = kUint});
    s.graph.compute("ism_atlas.choose_moving", "ism_atlas/choose_moving.comp")
        .read("segments", s.points.segments)
        .read("vals", s.vals.vals)
        .readWrite("chosen", s.atlas.chosen)
        .write("states", states)
        .spec(0, s.settings.nearMore)
        .push(push)
        .dispatchGroups(s.atlas.mapCount);
    s.graph.compute("ism_atlas.copy", "ism_atlas/copy_keys.comp")
        .read("still", stillKeys)
        .write("keys", keys)
        .push(push)
        .dispatchGroups(s.texelGroups(), s.atlas.mapCount);
    addSplat(s, "ism_atlas.splat_moving", states, keys, push)
        .read("listed", s.atlas.chosen)  // not looked at
        .dispatchGroups(splatGroups(push), s.atlas.mapCount);
    return keys;
}

}  // namespace

IsmAtlas addIsmAtlas(FrameGraph& graph, const SurfacePoints& points, const Vals& vals,
                     const IsmAtlasSettings& settings) {
    if (!settings.enabled || points.count == 0 || vals.count == 0) return {};
    IsmAtlas atlas{.mapCount = std::min(vals.count, io::kMaxIsms),
                   .tileSize = std::clamp(settings.tileSize / kTileSizeStep * kTileSizeStep, 16u, 128u),
                   .mapping = settings.mapping};
    const uint32_t perMap = atlas.pointsPerMap = std::min(settings.pointsPerMap, points.count);
    const uint32_t moving = movingEntries(points, perMap), still = perMap - moving;
    const uint64_t texels = uint64_t(atlas.mapCount) * atlas.tileSize * atlas.tileSize;
    atlas.planes = graph.buffer("ism_atlas.planes", {.sizeBytes = (texels + texels / 3 + 1) * 16,
                                                     .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT});
    const io::IsmSplatPush push{.pointCount = points.count,
                                .tileSize = atlas.tileSize,
                                .pointsPerMap = perMap,
                                .inverseExtent = 1 / points.extent,
                                .contents = contentsOf(settings, atlas, points, still)};
    const MapHistories kept{
        .places =
            graph.historyBuffer("ism_atlas.places", {.sizeBytes = atlas.mapCount * sizeof(io::IsmPlace)}),
        .chosen = graph.historyBuffer("ism_atlas.chosen",
                                      {.sizeBytes = atlas.mapCount * perMap * 4ull, .texelFormat = kUint}),
        .keys = graph.historyBuffer("ism_atlas.keys", {.sizeBytes = texels * 4, .texelFormat = kUint})};
    atlas.chosen = kept.chosen.current;
    atlas.states = graph.buffer("ism_atlas.states", {.sizeBytes = atlas.mapCount * sizeof(io::IsmMapState)});
    const Splat splat{graph, points, vals, settings, atlas};
    BufferHandle keys = kept.keys.current;
    addStillLayer(splat, kept, layerPush(push, points.still, 0, still, settings.splatScale));
    if (moving > 0)
        keys =
            addMovingLayer(splat, keys, layerPush(push, points.moving, still, moving, settings.splatScale));
    const BufferHandle resolved =
        settings.pullPush ? graph.buffer("ism_atlas.resolved", {.sizeBytes = texels * 16,
                                                                .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT})
                          : atlas.planes;
    graph.compute("ism_atlas.resolve", "ism_atlas/resolve_planes.comp")
        .read("points", points.points)
        .read("vals", vals.vals)
        .read("keys", keys)
        .read("chosen", atlas.chosen)
        .write("planes", resolved)
        .spec(0, settings.planes)
        .push(push)
        .dispatchGroups(splat.texelGroups(), atlas.mapCount);
    if (settings.pullPush) addPullPush(graph, resolved, atlas);
    return atlas;
}

}  // namespace ag::gi
