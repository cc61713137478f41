#include "gi/val_clustering.h"

#include <algorithm>
#include <span>

#include "engine/core/hash.h"

namespace ag::gi {
namespace {

constexpr VkFormat kVec4 = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kUint = VK_FORMAT_R32_UINT;

// Looks of adaption: a cluster is looked at every so many steps (ACRSM: 3).
constexpr uint32_t kOften = 3, kWhileLightMoves = 12, kWhileCameraMoves = 24, kNever = 0;

// Soon after a light started or stopped moving often; then seldom, so that most clusters and their shadow
// maps stay as they are. A cluster just split needs steps to find its place: none is in the last of them.
uint32_t lookPeriod(ValClusteringHistory& h, uint64_t lightVersion, uint32_t settleFrames) {
    const bool moves = h.lightVersion != lightVersion;
    h.sinceTurn = moves == h.lightMoves ? h.sinceTurn + 1 : 0;
    h.lightVersion = lightVersion;
    h.lightMoves = moves;
    const uint32_t splitting = settleFrames / 2;
    if (h.settling.sinceChange > splitting) return kNever;
    if (h.sinceTurn <= splitting) return kOften;
    return moves ? kWhileLightMoves : kWhileCameraMoves;
}

constexpr uint32_t kStepsBetweenSeeds = 1361;  // of the sequence that clusters start from

struct SeedPush {
    io::ClusterSettings settings;
    uint32_t faceCount;
    uint32_t pyramidStride;
};

// Clusters and how far they reach, of this step and the one before.
struct State {
    HistoryBuffer clusters, extents;
};

// What tiles have of clusters: summed tile by tile, then cluster by cluster.
struct Partials {
    BufferHandle sums, of, count;  // io::kPartialVec4s each; per tile and cluster which one; how many
    uint32_t most = 0;
};

// A tile has no more than candidates. A cluster is one within its map's radius, and where a probe of a tile
// (one of 16) is nearest to it; as many again where no cluster is within the radius.
uint32_t mostPartials(const RsmSet& rsm) {
    constexpr uint32_t kBeyondRadius = 2 * 16;
    uint32_t most = 0;
    for (const io::RsmMap& map : std::span(rsm.mapInfo).first(rsm.atlas.mapCount)) {
        const uint32_t along = rsm.faceInfo[map.firstFace].size / io::kRsmTileSize;
        const uint32_t tiles = map.faceCount * along * along, window = 2 * map.candidateRadius + 1;
        most += std::min(tiles * std::min(map.clusterCount, io::kMaxCandidates),
                         window * window * map.clusterCount + kBeyondRadius * tiles);
    }
    return most;
}

Partials addPartials(GraphScope scope, const RsmSet& rsm, uint32_t clusterCount) {
    Partials p{.most = mostPartials(rsm)};
    p.sums = scope.buffer(
        "val_clustering.partials",
        {.sizeBytes = uint64_t(p.most) * io::kPartialVec4s * sizeof(glm::vec4), .texelFormat = kVec4});
    p.of = scope.buffer("val_clustering.partial_of",
                        {.sizeBytes = uint64_t(rsm.tileCount) * clusterCount * 4, .texelFormat = kUint});
    p.count = scope.buffer("val_clustering.partial_count", {.sizeBytes = 4});
    constexpr uint32_t kNone = 0;
    scope.upload("val_clustering.no_partials", p.count, std::as_bytes(std::span(&kNone, 1)));
    return p;
}

BufferHandle addAdaption(GraphScope scope, const RsmSet& rsm, const Importance& importance,
                         const State& state, const io::ClusterSettings& push) {
    const BufferHandle errors =
        scope.buffer("val_clustering.errors", {.sizeBytes = push.clusterCount * sizeof(io::ClusterError)});
    scope.compute("val_clustering.evaluate", "val_clustering/evaluate.comp")
        .readPrevious("previous", state.clusters)
        .read("viewPoints", importance.viewDependent() ? importance.viewPoints : rsm.texels)
        .constant("kFromView", importance.viewDependent())
        .write("errors", errors)
        .push(push)
        .dispatchGroups(push.clusterCount);
    const BufferHandle plans =
        scope.buffer("val_clustering.plans", {.sizeBytes = push.clusterCount * sizeof(uint32_t)});
    scope.compute("val_clustering.adapt", "val_clustering/adapt.comp")
        .readPrevious("previous", state.clusters)
        .readPrevious("extents", state.extents)
        .read("maps", rsm.maps)
        .read("texels", rsm.texels)
        .read("errors", errors)
        .write("plans", plans)
        .push(push)
        .dispatchGroups(push.mapCount);
    return plans;
}

struct SeedBuffers {
    BufferHandle plans, seeds;
};

void addSeeding(GraphScope scope, const RsmSet& rsm, const Importance& importance,
                const HistoryBuffer& clusters, const SeedBuffers& of, const io::ClusterSettings& push) {
    scope.compute("val_clustering.seed", "val_clustering/seed.comp")
        .read("texels", rsm.texels)
        .read("faces", rsm.faces)
        .read("maps", rsm.maps)
        .read("pyramid", importance.pyramid)
        .readPrevious("previous", clusters)
        .read("plans", of.plans ? of.plans : rsm.maps)
        .constant("kAdaptive", bool(of.plans))
        .write("seeds", of.seeds)
        .push(SeedPush{push, rsm.atlas.faceCount, importance.pyramidStride})
        .dispatchThreads(push.clusterCount);
}

void addAssignment(GraphScope scope, const RsmSet& rsm, const Clusters& c, const Partials& partials,
                   const io::ClusterSettings& push) {
    scope.compute("val_clustering.gather_candidates", "val_clustering/gather_candidates.comp")
        .read("texels", rsm.texels)
        .read("seeds", c.seeds)
        .read("maps", rsm.maps)
        .read("tileMaps", rsm.tileMaps)
        .write("candidates", c.candidates)
        .write("candidateCounts", c.candidateCounts)
        .write("partialOf", partials.of)
        .push(push)
        .dispatchGroups(rsm.tileCount);
    scope.compute("val_clustering.assign", "val_clustering/assign_texels.comp")
        .read("texels", rsm.texels)
        .read("seeds", c.seeds)
        .read("candidates", c.candidates)
        .read("candidateCounts", c.candidateCounts)
        .write("slotOfTexel", c.slotOfTexel)
        .push(push)
        .dispatchGroups(rsm.tileCount);
}

void addUpdate(GraphScope scope, const RsmSet& rsm, const Clusters& c, const Partials& partials,
               const io::ClusterSettings& push) {
    scope.compute("val_clustering.sum_tiles", "val_clustering/sum_tiles.comp")
        .read("texels", rsm.texels)
        .read("seeds", c.seeds)
        .read("candidates", c.candidates)
        .read("slotOfTexel", c.slotOfTexel)
        .read("candidateCounts", c.candidateCounts)
        .write("partials", partials.sums)
        .readWrite("partialOf", partials.of)
        .readWrite("partialCount", partials.count)
        .push(glm::uvec2(push.clusterCount, partials.most))
        .dispatchGroups(rsm.tileCount);
    scope.compute("val_clustering.update", "val_clustering/update_clusters.comp")
        .read("seeds", c.seeds)
        .read("maps", rsm.maps)
        .read("partialOf", partials.of)
        .read("partials", partials.sums)
        .write("clusters", c.clusters)
        .write("extents", c.extents)
        .push(push)
        .dispatchGroups(c.count);
}

}  // namespace

glm::vec4 metricWeights(const ValClusteringSettings& s) {
    return {s.distanceWeight, s.normalWeight, s.chromaWeight, s.planeWeight};
}

Clusters addValClustering(GraphScope scope, const RsmSet& rsm, const Importance& importance,
                          const ValClusteringSettings& settings, uint64_t viewVersion,
                          ValClusteringHistory& history) {
    if (rsm.empty()) return {};
    const uint64_t light = combineHash(rsm.inputsVersion, hashFields(settings));
    const uint64_t inputs = combineHash(light, importance.viewDependent() ? viewVersion : 0);
    // Past that the clusters rest, and everything behind them is skipped.
    const bool late = scope.isHeld();
    const uint32_t step =
        late ? history.settling.step : history.settling.advance(inputs, settings.settleFrames);
    const io::ClusterSettings push{
        .metricWeights = metricWeights(settings),
        .clusterCount = settings.count,
        .atlasSize = rsm.atlas.size,
        .mapCount = rsm.atlas.mapCount,
        .viewWeight = importance.viewWeight,
        .lookPeriod = late ? kNever : lookPeriod(history, light, settings.settleFrames),
        .step = step + kStepsBetweenSeeds * settings.seed};

    const uint64_t texelCount = uint64_t(rsm.tileCount) * io::kRsmTileSize * io::kRsmTileSize;
    const State state{
        scope.historyBuffer("val_clustering.clusters",
                            {.sizeBytes = settings.count * sizeof(io::Cluster), .texelFormat = kVec4}),
        scope.historyBuffer("val_clustering.extents",
                            {.sizeBytes = settings.count * sizeof(io::ClusterExtent)})};
    Clusters c{.clusters = state.clusters.current, .extents = state.extents.current, .count = settings.count};
    c.seeds = scope.buffer("val_clustering.seeds",
                           {.sizeBytes = settings.count * sizeof(io::ClusterSeed), .texelFormat = kVec4});
    c.candidates =
        scope.buffer("val_clustering.candidates",
                     {.sizeBytes = uint64_t(rsm.tileCount) * io::kMaxCandidates * 4, .texelFormat = kUint});
    c.candidateCounts = scope.buffer("val_clustering.candidate_counts", {.sizeBytes = rsm.tileCount * 4ull});
    c.slotOfTexel =
        scope.buffer("val_clustering.slot_of_texel", {.sizeBytes = texelCount * 4, .texelFormat = kUint});
    const Partials partials = addPartials(scope, rsm, settings.count);
    c.partialOf = partials.of;
    c.partials = partials.sums;
    c.mostPartials = partials.most;

    const BufferHandle plans =
        settings.adaptive ? addAdaption(scope, rsm, importance, state, push) : BufferHandle{};
    addSeeding(scope, rsm, importance, state.clusters, {plans, c.seeds}, push);
    addAssignment(scope, rsm, c, partials, push);
    addUpdate(scope, rsm, c, partials, push);
    return c;
}

}  // namespace ag::gi
