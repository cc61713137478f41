#include "gi/ism_atlas.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/hash.h"
#include "gi/pixel_list.h"

namespace ag::gi {
namespace {

constexpr uint32_t kTileSizeStep = io::kIsmRegionSide;
constexpr uint32_t kMostListed = 65535;  // groups of a dispatch on any device
constexpr VkFormat kUint = VK_FORMAT_R32_UINT;

constexpr WorkListNames kMapsAnew = {"ism_atlas.anew", "ism_atlas.anew_groups", "ism_atlas.none_anew"};
struct RegionNames {
    std::string_view pass;
    WorkListNames list;
};
constexpr RegionNames kRestored = {
    "ism_atlas.list_restored",
    {"ism_atlas.restored", "ism_atlas.restored_groups", "ism_atlas.none_restored"}};
constexpr RegionNames kFinished = {
    "ism_atlas.list_finished",
    {"ism_atlas.finished", "ism_atlas.finished_groups", "ism_atlas.none_finished"}};

// What static layers are made of and like, as a number; 0: none are kept.
uint32_t contentsOf(const IsmAtlasSettings& s, const IsmAtlas& atlas, const SurfacePoints& points,
                    uint32_t staticEntries) {
    if (!s.keepMaps) return 0;
    const uint64_t size =
        hashValue(glm::uvec4(atlas.mapCount, atlas.tileSize, atlas.pointsPerMap, staticEntries));
    const uint64_t like =
        combineHash(hashValue(glm::vec4(s.splatScale, float(s.mapping), float(s.nearMore), points.extent)),
                    uint64_t(s.planes) * 2 + s.pullPush);
    return uint32_t(combineHash(combineHash(size, like), points.staticVersion)) | 1;
}

// What makes the static layer of a map, kept for those whose light and points have not moved.
struct MapHistories {
    HistoryBuffer places, chosen, keys;
};

// How many of a map's points movable surfaces get: their share of the area within bounds, as what moves is
// looked at.
uint32_t movableEntries(const SurfacePoints& points, uint32_t pointsPerMap) {
    if (points.movableLayer.count == 0) return 0;
    if (points.staticLayer.count == 0) return pointsPerMap;
    const float share = float(points.movableLayer.count) / float(points.count);
    const float wanted = std::clamp(share, 0.125f, 0.5f) * float(pointsPerMap);
    return std::min({uint32_t(wanted), points.movableLayer.count, pointsPerMap - 1});
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

uint32_t regionsOf(uint32_t tileSize) {
    return (tileSize / io::kIsmRegionSide) * (tileSize / io::kIsmRegionSide);
}

struct Splat {
    GraphScope scope;
    const SurfacePoints& points;
    const Vals& vals;
    const IsmAtlasSettings& settings;
    const IsmAtlas& atlas;
    uint32_t texelGroups() const { return atlas.tileSize * atlas.tileSize / 256; }
    uint32_t regions() const { return atlas.mapCount * regionsOf(atlas.tileSize); }
};

struct MapPush {
    io::IsmSplatPush splat;
    uint32_t mapCount;
};

uint32_t splatGroups(const io::IsmSplatPush& push) {
    return (push.entryCount + 63) / 64;
}

PassBuilder addSplat(const Splat& s, std::string_view name, BufferHandle chosen, BufferHandle states,
                     BufferHandle keys, const io::IsmSplatPush& push) {
    PassBuilder pass = s.scope.compute(name, "ism_atlas/splat_points.comp");
    pass.read("vals", s.vals.vals)
        .read("chosen", chosen)
        .read("states", states)
        .readWrite("keys", keys)
        .constant("kParaboloid", s.settings.mapping == IsmMapping::kParaboloid)
        .push(push);
    return pass;
}

// All that is static: maps are kept where neither it nor the light has moved; a splat of those would cost
// its workgroups all the same, so the others are listed.
void addStaticLayer(const Splat& s, const MapHistories& kept, const io::IsmSplatPush& push) {
    const WorkList anew = addWorkList(s.scope, kMapsAnew, s.atlas.mapCount, {splatGroups(push), 0, 1});
    s.scope.compute("ism_atlas.choose", "ism_atlas/choose_static.comp")
        .readPart("segments", s.points.segments, s.points.staticVersion)
        .read("vals", s.vals.vals)
        .readPrevious("previousPlaces", kept.places)
        .readPrevious("previousChosen", kept.chosen)
        .write("places", kept.places.current)
        .write("chosen", kept.chosen.current)
        .write("states", s.atlas.states)
        .write("anew", anew.items)
        .readWrite("anewGroups", anew.groups)
        .constant("kByDistance", s.settings.nearMore)
        .push(push)
        .dispatchGroups(s.atlas.mapCount);
    s.scope.compute("ism_atlas.keep", "ism_atlas/keep_maps.comp")
        .readPrevious("previousKeys", kept.keys)
        .read("states", s.atlas.states)
        .write("keys", kept.keys.current)
        .push(push)
        .dispatchGroups(s.texelGroups(), s.atlas.mapCount);
    addSplat(s, "ism_atlas.splat", s.atlas.chosen, s.atlas.states, kept.keys.current, push)
        .readPart("points", s.points.points, s.points.staticVersion)
        .readWrite("finishes", kept.keys.current)  // not looked at
        .read("listed", anew.items)
        .constant("kListed", true)
        .dispatchIndirect(anew.groups);
}

// Regions of maps, see list_regions.comp.
WorkList addRegions(const Splat& s, const RegionNames& names, BufferHandle places,
                    const HistoryBuffer& finishes, bool before, const io::IsmSplatPush& push) {
    const WorkList regions = addWorkList(s.scope, names.list, s.regions(), {0, 1, 1});
    s.scope.compute(names.pass, "ism_atlas/list_regions.comp")
        .read("places", places)
        .readPrevious("previousFinishes", finishes)
        .readWrite("finishes", finishes.current)
        .write("listed", regions.items)
        .readWrite("groups", regions.groups)
        .constant("kBefore", before)
        .push(MapPush{push, s.atlas.mapCount})
        .dispatchThreads(s.atlas.mapCount);
    return regions;
}

struct MovableLayer {
    BufferHandle keys, chosen;
};

// What may move, over the static layer: only where it shows or showed in the frame before is anything done.
MovableLayer addMovableLayer(const Splat& s, BufferHandle staticKeys, BufferHandle finishes,
                             const WorkList& restored, const io::IsmSplatPush& push) {
    const BufferHandle states =
        s.scope.buffer("ism_atlas.movable_states", {.sizeBytes = s.atlas.mapCount * sizeof(io::IsmMapState)});
    const BufferHandle keys = s.scope.buffer("ism_atlas.all_keys", s.scope.info(staticKeys));
    const BufferHandle chosen =
        s.scope.buffer("ism_atlas.movable_chosen",
                       {.sizeBytes = s.atlas.mapCount * push.entryCount * 4ull, .texelFormat = kUint});
    s.scope.compute("ism_atlas.choose_movable", "ism_atlas/choose_movable.comp")
        .read("segments", s.points.segments)
        .read("vals", s.vals.vals)
        .write("chosen", chosen)
        .write("states", states)
        .constant("kByDistance", s.settings.nearMore)
        .push(push)
        .dispatchGroups(s.atlas.mapCount);
    s.scope.compute("ism_atlas.restore", "ism_atlas/restore_keys.comp")
        .read("listed", restored.items)
        .read("staticKeys", staticKeys)
        .write("keys", keys)
        .push(push)
        .dispatchIndirect(restored.groups);
    addSplat(s, "ism_atlas.splat_movable", chosen, states, keys, push)
        .read("points", s.points.points)
        .readWrite("finishes", finishes)
        .read("listed", chosen)  // not looked at
        .constant("kMarks", true)
        .dispatchGroups(splatGroups(push), s.atlas.mapCount);
    return {keys, chosen};
}

// From the nearest points to planes without holes, where maps may be otherwise than they were.
void addFinish(const Splat& s, const MovableLayer& layer, const WorkList& finished,
               const io::IsmSplatPush& push) {
    const BufferHandle resolved = s.settings.pullPush
                                      ? s.scope.buffer("ism_atlas.resolved", s.scope.info(s.atlas.planes))
                                      : s.atlas.planes;
    s.scope.compute("ism_atlas.resolve", "ism_atlas/resolve_planes.comp")
        .read("points", s.points.points)
        .read("vals", s.vals.vals)
        .read("keys", layer.keys)
        .read("staticChosen", s.atlas.chosen)
        .read("movableChosen", layer.chosen)
        .read("listed", finished.items)
        .write("planes", resolved)
        .constant("kPlanes", s.settings.planes)
        .constant("kLast", !s.settings.pullPush)
        .constant("kMovable", push.entryCount > 0)
        .push(push)
        .dispatchIndirect(finished.groups);
    if (!s.settings.pullPush) return;
    s.scope.compute("ism_atlas.close", "ism_atlas/close_holes.comp")
        .read("resolved", resolved)
        .read("listed", finished.items)
        .write("planes", s.atlas.planes)
        .constant("kParaboloid", s.atlas.mapping == IsmMapping::kParaboloid)
        .push(push)
        .dispatchIndirect(finished.groups);
}

// The largest maps there may be so many of.
uint32_t tileSizeFor(uint32_t asked, uint32_t mapCount) {
    uint32_t size = std::clamp(asked / kTileSizeStep * kTileSizeStep, kTileSizeStep, 128u);
    while (mapCount * regionsOf(size) > kMostListed)
        size -= kTileSizeStep;
    return size;
}

}  // namespace

IsmAtlas addIsmAtlas(GraphScope scope, const SurfacePoints& points, const Vals& vals,
                     const IsmAtlasSettings& settings) {
    if (!settings.enabled || points.count == 0 || vals.count == 0) return {};
    IsmAtlas atlas{.mapCount = std::min(vals.count, io::kMaxIsms), .mapping = settings.mapping};
    atlas.tileSize = tileSizeFor(settings.tileSize, atlas.mapCount);
    const uint32_t perMap = atlas.pointsPerMap = std::min(settings.pointsPerMap, points.count);
    const uint32_t movableCount = movableEntries(points, perMap), staticCount = perMap - movableCount;
    const uint64_t texels = uint64_t(atlas.mapCount) * atlas.tileSize * atlas.tileSize;
    atlas.planes = scope.buffer("ism_atlas.planes",
                                {.sizeBytes = texels * 16, .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT});
    const io::IsmSplatPush push{.pointCount = points.count,
                                .tileSize = atlas.tileSize,
                                .inverseExtent = 1 / points.extent,
                                .contents = contentsOf(settings, atlas, points, staticCount)};
    const MapHistories kept{
        .places =
            scope.historyBuffer("ism_atlas.places", {.sizeBytes = atlas.mapCount * sizeof(io::IsmPlace)}),
        .chosen = scope.historyBuffer(
            "ism_atlas.chosen",
            {.sizeBytes = std::max(staticCount, 1u) * atlas.mapCount * 4ull, .texelFormat = kUint}),
        .keys = scope.historyBuffer("ism_atlas.keys", {.sizeBytes = texels * 4, .texelFormat = kUint})};
    atlas.chosen = kept.chosen.current;
    atlas.states = scope.buffer("ism_atlas.states", {.sizeBytes = atlas.mapCount * sizeof(io::IsmMapState)});
    const Splat splat{scope, points, vals, settings, atlas};
    addStaticLayer(splat, kept, layerPush(push, points.staticLayer, 0, staticCount, settings.splatScale));
    const HistoryBuffer finishes =
        scope.historyBuffer("ism_atlas.finishes", {.sizeBytes = atlas.mapCount * sizeof(io::IsmFinish)});
    const WorkList restored = addRegions(splat, kRestored, kept.places.current, finishes, true, push);
    const io::IsmSplatPush movablePush =
        layerPush(push, points.movableLayer, staticCount, movableCount, settings.splatScale);
    MovableLayer all{kept.keys.current, atlas.chosen};
    if (movableCount > 0) all = addMovableLayer(splat, all.keys, finishes.current, restored, movablePush);
    const WorkList finished = addRegions(splat, kFinished, kept.places.current, finishes, false, push);
    addFinish(splat, all, finished, movablePush);
    return atlas;
}

}  // namespace ag::gi
