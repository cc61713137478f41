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

// What static layers are made of (`of`: a version of the surfaces) and like, as a number; 0: none are kept.
uint32_t contentsOf(const IsmAtlasSettings& s, const IsmAtlas& atlas, const SurfacePoints& points,
                    uint32_t staticEntries, uint64_t of) {
    if (!s.keepMaps) return 0;
    const uint64_t size =
        hashValue(glm::uvec4(atlas.mapCount, atlas.tileSize, atlas.pointsPerMap, staticEntries));
    const uint64_t like =
        combineHash(hashValue(glm::vec4(s.splatScale, float(s.mapping), float(s.nearMore), points.extent)),
                    uint64_t(s.planes) * 2 + s.pullPush);
    return uint32_t(combineHash(combineHash(size, like), of)) | 1;
}

// All that is static, kept for maps whose light and surfaces have not moved: the nearest points, or traced
// planes.
struct StaticLayer {
    BufferHandle keys, chosen;
    BufferHandle planes;  // valid: of rays, map by map, row by row; then there are no keys
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

// The half of a layer's history that is now, as it was where maps are kept.
void addKeptMaps(const Splat& s, std::string_view name, std::string_view shader, const HistoryBuffer& layer,
                 const io::IsmSplatPush& push) {
    s.scope.compute(name, shader)
        .readPrevious("previous", layer)
        .read("states", s.atlas.states)
        .write("kept", layer.current)
        .push(push)
        .dispatchGroups(s.texelGroups(), s.atlas.mapCount);
}

// Maps that are not kept are listed: a splat of the others would cost its workgroups all the same.
StaticLayer addSplattedLayer(const Splat& s, const HistoryBuffer& places, const io::IsmSplatPush& push) {
    const uint32_t texels = s.atlas.mapCount * s.atlas.tileSize * s.atlas.tileSize;
    const HistoryBuffer chosen = s.scope.historyBuffer(
        "ism_atlas.chosen",
        {.sizeBytes = std::max(push.entryCount, 1u) * s.atlas.mapCount * 4ull, .texelFormat = kUint});
    const HistoryBuffer keys =
        s.scope.historyBuffer("ism_atlas.keys", {.sizeBytes = texels * 4ull, .texelFormat = kUint});
    const WorkList anew = addWorkList(s.scope, kMapsAnew, s.atlas.mapCount, {splatGroups(push), 0, 1});
    s.scope.compute("ism_atlas.choose", "ism_atlas/choose_static.comp")
        .readPart("segments", s.points.segments, s.points.staticVersion)
        .read("vals", s.vals.vals)
        .readPrevious("previousPlaces", places)
        .readPrevious("previousChosen", chosen)
        .write("places", places.current)
        .write("chosen", chosen.current)
        .write("states", s.atlas.states)
        .write("anew", anew.items)
        .readWrite("anewGroups", anew.groups)
        .constant("kByDistance", s.settings.nearMore)
        .push(push)
        .dispatchGroups(s.atlas.mapCount);
    addKeptMaps(s, "ism_atlas.keep", "ism_atlas/keep_maps.comp", keys, push);
    addSplat(s, "ism_atlas.splat", chosen.current, s.atlas.states, keys.current, push)
        .readPart("points", s.points.points, s.points.staticVersion)
        .readWrite("finishes", keys.current)  // not looked at
        .read("listed", anew.items)
        .constant("kListed", true)
        .dispatchIndirect(anew.groups);
    return {.keys = keys.current, .chosen = chosen.current};
}

// The same by a ray a texel.
StaticLayer addTracedLayer(const Splat& s, const TracedOccluders& trees, const HistoryBuffer& places,
                           const io::IsmSplatPush& push, const BufferInfo& info) {
    constexpr uint32_t kGroupTexels = 64;
    const uint32_t groups = s.atlas.tileSize * s.atlas.tileSize / kGroupTexels;
    const WorkList anew = addWorkList(s.scope, kMapsAnew, s.atlas.mapCount, {groups, 0, 1});
    const HistoryBuffer planes = s.scope.historyBuffer("ism_atlas.traced", info);
    s.scope.compute("ism_atlas.list", "ism_atlas/list_traced.comp")
        .read("vals", s.vals.vals)
        .readPrevious("previousPlaces", places)
        .write("places", places.current)
        .write("states", s.atlas.states)
        .write("anew", anew.items)
        .readWrite("anewGroups", anew.groups)
        .push(MapPush{push, s.atlas.mapCount})
        .dispatchThreads(s.atlas.mapCount);
    addKeptMaps(s, "ism_atlas.keep_traced", "ism_atlas/keep_planes.comp", planes, push);
    s.scope.compute("ism_atlas.trace", "ism_atlas/trace_maps.comp")
        .read("vals", s.vals.vals)
        .read("listed", anew.items)
        .read("treeNodes", trees.nodes)
        .read("treeTriangles", trees.triangles)
        .readPart("treePlaces", trees.places, trees.staticVersion)
        .readWrite("planes", planes.current)
        .constant("kParaboloid", s.settings.mapping == IsmMapping::kParaboloid)
        .push(push)
        .dispatchIndirect(anew.groups);
    return {.planes = planes.current};
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
MovableLayer addMovableLayer(const Splat& s, const StaticLayer& still, BufferHandle finishes,
                             const WorkList& restored, const io::IsmSplatPush& push) {
    const BufferHandle states =
        s.scope.buffer("ism_atlas.movable_states", {.sizeBytes = s.atlas.mapCount * sizeof(io::IsmMapState)});
    const uint64_t texels = s.scope.info(s.atlas.planes).sizeBytes / sizeof(glm::vec4);
    const BufferHandle keys =
        s.scope.buffer("ism_atlas.all_keys", {.sizeBytes = texels * 4, .texelFormat = kUint});
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
        .read("staticKeys", still.planes ? chosen : still.keys)
        .write("keys", keys)
        .constant("kTraced", bool(still.planes))
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
void addFinish(const Splat& s, const StaticLayer& still, const MovableLayer& layer, const WorkList& finished,
               const io::IsmSplatPush& push) {
    const BufferHandle resolved = s.settings.pullPush
                                      ? s.scope.buffer("ism_atlas.resolved", s.scope.info(s.atlas.planes))
                                      : s.atlas.planes;
    s.scope.compute("ism_atlas.resolve", "ism_atlas/resolve_planes.comp")
        .read("points", s.points.points)
        .read("vals", s.vals.vals)
        .read("keys", layer.keys)
        .read("staticChosen", still.planes ? layer.chosen : still.chosen)
        .read("movableChosen", layer.chosen)
        .read("tracedPlanes", still.planes ? still.planes : s.vals.vals)
        .read("listed", finished.items)
        .write("planes", resolved)
        .constant("kTraced", bool(still.planes))
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
        .constant("kTraced", bool(still.planes))
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

IsmAtlas addIsmAtlas(GraphScope scope, const SurfacePoints& points, const TracedOccluders& trees,
                     const Vals& vals, const IsmAtlasSettings& settings) {
    if (!settings.enabled || points.count == 0 || vals.count == 0) return {};
    IsmAtlas atlas{.mapCount = std::min(vals.count, io::kMaxIsms), .mapping = settings.mapping};
    atlas.tileSize = tileSizeFor(settings.tileSize, atlas.mapCount);
    const bool traced = settings.traced && trees;
    const uint32_t perMap = atlas.pointsPerMap = std::min(settings.pointsPerMap, points.count);
    const uint32_t movableCount = movableEntries(points, perMap),
                   staticCount = traced ? 0 : perMap - movableCount;
    const uint64_t texels = uint64_t(atlas.mapCount) * atlas.tileSize * atlas.tileSize;
    const BufferInfo planes{.sizeBytes = texels * 16, .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT};
    // Traced or splatted, the numbers are never those of the other.
    const uint64_t surfaces =
        traced ? combineHash(trees.staticVersion, 1) : combineHash(points.staticVersion, 2);
    const io::IsmSplatPush push{.pointCount = points.count,
                                .tileSize = atlas.tileSize,
                                .inverseExtent = 1 / points.extent,
                                .contents = contentsOf(settings, atlas, points, staticCount, surfaces)};
    const HistoryBuffer places =
        scope.historyBuffer("ism_atlas.places", {.sizeBytes = atlas.mapCount * sizeof(io::IsmPlace)});
    atlas.states = scope.buffer("ism_atlas.states", {.sizeBytes = atlas.mapCount * sizeof(io::IsmMapState)});
    const Splat splat{scope, points, vals, settings, atlas};
    const StaticLayer still =
        traced ? addTracedLayer(splat, trees, places, push, planes)
               : addSplattedLayer(splat, places,
                                  layerPush(push, points.staticLayer, 0, staticCount, settings.splatScale));
    atlas.chosen = still.chosen;
    if (traced && movableCount == 0) {
        atlas.planes = still.planes;
        return atlas;
    }
    atlas.planes = scope.buffer("ism_atlas.planes", planes);
    const HistoryBuffer finishes =
        scope.historyBuffer("ism_atlas.finishes", {.sizeBytes = atlas.mapCount * sizeof(io::IsmFinish)});
    const WorkList restored = addRegions(splat, kRestored, places.current, finishes, true, push);
    const io::IsmSplatPush movablePush =
        layerPush(push, points.movableLayer, staticCount, movableCount, settings.splatScale);
    MovableLayer all{still.keys, still.chosen};
    if (movableCount > 0) all = addMovableLayer(splat, still, finishes.current, restored, movablePush);
    const WorkList finished = addRegions(splat, kFinished, places.current, finishes, false, push);
    addFinish(splat, still, all, finished, movablePush);
    return atlas;
}

}  // namespace ag::gi
