// Integers must not depend on the device where their order is defined: which clusters a tile of RSM texels
// considers, in which order, and which of them each texel gets. Numbers are such that every step is exact in
// floats.
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "common/clustering_metric.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/transfer.h"
#include "shaders/rsm/rsm_io.h"
#include "shaders/val_clustering/val_clustering_io.h"
#include "tests/support/device_environment.h"

namespace ag {
namespace {

constexpr uint32_t kTilesX = 4, kTiles = kTilesX * kTilesX, kClusters = 200, kRadius = 1;
constexpr uint32_t kTileTexels = io::kRsmTileSize * io::kRsmTileSize;
constexpr VkFormat kVec4 = VK_FORMAT_R32G32B32A32_SFLOAT;
// Chroma, which takes a root, counts for nothing.
constexpr io::ClusterSettings kSettings{.metricWeights = {1, 0.5f, 0, 0.25f},
                                        .clusterCount = kClusters,
                                        .atlasSize = glm::uvec2(kTilesX * io::kRsmTileSize),
                                        .mapCount = 1};

struct Input {
    std::vector<io::RsmTexel> texels;
    std::vector<io::ClusterSeed> seeds;
    std::vector<uint32_t> mapOfTile = std::vector<uint32_t>(kTiles, 0);
    std::vector<io::RsmMap> maps = std::vector<io::RsmMap>(io::kMaxRsmMaps);
};

Input makeInput() {
    Input in;
    std::mt19937 random(7);
    const auto upTo = [&](uint32_t most) { return uint32_t(random() % (most + 1)); };
    const auto place = [&] { return glm::vec3(float(upTo(64)), float(upTo(64)), float(upTo(64))) * 0.125f; };
    const auto axis = [&] {
        glm::vec3 n(0);
        n[int(upTo(2))] = upTo(1) ? 1.0f : -1.0f;
        return n;
    };
    for (uint32_t i = 0; i < kTiles * kTileTexels; ++i)
        in.texels.push_back({.position = place(),
                             .area = 1,
                             .normal = axis(),
                             .weight = upTo(7) ? 1.0f : 0.0f,
                             .flux = glm::vec3(1),
                             .emitterCosine = 1});
    for (uint32_t i = 0; i < kClusters; ++i)
        in.seeds.push_back({.position = place(),
                            .tile = upTo(9) ? upTo(kTiles - 1) : io::kNoCluster,
                            .normal = axis(),
                            .map = 0,
                            .chroma = axis()});
    in.mapOfTile[5] = io::kNoCluster;
    in.maps[0].candidateRadius = kRadius;
    return in;
}

float metric(const io::RsmTexel& t, const io::ClusterSeed& s) {
    return io::clusterMetric(t.position, t.normal, glm::vec3(0), s.position, s.normal, glm::vec3(0),
                             kSettings.metricWeights);
}

// gather_candidates.comp, one tile.
std::vector<uint32_t> candidatesOf(const Input& in, uint32_t tile) {
    std::vector<uint32_t> distance(kClusters, ~0u), nearest;
    uint32_t least = ~0u;
    for (uint32_t c = 0; c < kClusters; ++c) {
        const uint32_t at = in.seeds[c].tile;
        if (at == io::kNoCluster) continue;
        const glm::ivec2 d =
            glm::abs(glm::ivec2(at % kTilesX, at / kTilesX) - glm::ivec2(tile % kTilesX, tile / kTilesX));
        distance[c] = uint32_t(std::max(d.x, d.y));
        least = std::min(least, distance[c]);
    }
    for (uint32_t row = 0; row < io::kRsmTileSize; ++row) {
        const io::RsmTexel& t =
            in.texels[tile * kTileTexels + row * io::kRsmTileSize + (row * 5 + 3) % io::kRsmTileSize];
        if (t.weight == 0) continue;
        uint32_t best = io::kNoCluster;
        for (uint32_t c = 0; c < kClusters; ++c)
            if (distance[c] != ~0u &&
                (best == io::kNoCluster || metric(t, in.seeds[c]) < metric(t, in.seeds[best])))
                best = c;
        nearest.push_back(best);
    }
    std::vector<uint32_t> list;
    const bool any = in.mapOfTile[tile] != io::kNoCluster && least != ~0u;
    for (uint32_t c = 0; any && c < kClusters; ++c)
        if ((distance[c] != ~0u && distance[c] <= std::max(kRadius, least)) ||
            std::ranges::count(nearest, c) > 0)
            list.push_back(c);
    return list;
}

uint32_t slotOf(const Input& in, const io::RsmTexel& texel, const std::vector<uint32_t>& candidates) {
    uint32_t best = io::kNoCluster;
    for (uint32_t slot = 0; slot < candidates.size() && texel.weight > 0; ++slot)
        if (best == io::kNoCluster ||
            metric(texel, in.seeds[candidates[slot]]) < metric(texel, in.seeds[candidates[best]]))
            best = slot;
    return best;
}

struct Output {
    std::vector<uint32_t> candidates, counts, slots;
};

Output runOnDevice(const Input& in) {
    gpu::Device& device = test::device();
    FrameGraph graph(&device.context(), &device.pipelines());
    const auto texels = gpu::loadBuffer(device, {.name = "texels", .texelFormat = kVec4}, in.texels);
    const auto seeds = gpu::loadBuffer(device, {.name = "seeds", .texelFormat = kVec4}, in.seeds);
    const auto maps = gpu::loadBuffer(device, {.name = "maps"}, in.maps);
    const auto tileMaps = gpu::loadBuffer(device, {.name = "tile_maps"}, in.mapOfTile);
    graph.beginFrame({.timing = TimingMode::kOff});
    const auto words = [&](const char* name, uint64_t count, VkFormat format = VK_FORMAT_UNDEFINED) {
        return graph.buffer(name, {.sizeBytes = count * 4, .texelFormat = format});
    };
    const BufferHandle texel = graph.importBuffer("texels", *texels, 1),
                       seed = graph.importBuffer("seeds", *seeds, 1),
                       map = graph.importBuffer("maps", *maps, 1),
                       tileMap = graph.importBuffer("tile_maps", *tileMaps, 1),
                       candidates = words("candidates", kTiles * io::kMaxCandidates, VK_FORMAT_R32_UINT),
                       counts = words("counts", kTiles), slots = words("slots", kTiles * kTileTexels),
                       partialOf = words("partial_of", kTiles * kClusters);
    graph.compute("gather", "val_clustering/gather_candidates.comp")
        .read("seeds", seed)
        .read("maps", map)
        .read("tileMaps", tileMap)
        .read("texels", texel)
        .write("candidates", candidates)
        .write("candidateCounts", counts)
        .write("partialOf", partialOf)
        .push(kSettings)
        .dispatchGroups(kTiles);
    graph.compute("assign", "val_clustering/assign_texels.comp")
        .read("texels", texel)
        .read("seeds", seed)
        .read("candidates", candidates)
        .read("candidateCounts", counts)
        .write("slotOfTexel", slots)
        .push(kSettings)
        .dispatchGroups(kTiles);
    for (const BufferHandle output : {candidates, counts, slots})
        graph.output(output);
    device.runOnce([&](VkCommandBuffer commands) { graph.execute(commands); });
    const auto read = [&](BufferHandle handle) {
        const gpu::Buffer& buffer = graph.physical(handle);
        std::vector<uint32_t> items(buffer.sizeBytes() / 4);
        gpu::downloadBuffer(device, buffer, std::as_writable_bytes(std::span(items)));
        return items;
    };
    return {read(candidates), read(counts), read(slots)};
}

TEST(Devices, AssignmentsAreTheSameIntegers) {
    const Input in = makeInput();
    const Output out = runOnDevice(in);
    uint32_t lit = 0;
    for (uint32_t tile = 0; tile < kTiles; ++tile) {
        const std::vector<uint32_t> expected = candidatesOf(in, tile);
        const auto first = out.candidates.begin() + tile * io::kMaxCandidates;
        ASSERT_EQ(std::vector(first, first + out.counts[tile]), expected) << "tile " << tile;
        for (uint32_t i = tile * kTileTexels; i < (tile + 1) * kTileTexels; ++i) {
            ASSERT_EQ(out.slots[i], slotOf(in, in.texels[i], expected)) << "texel " << i;
            lit += out.slots[i] != io::kNoCluster;
        }
    }
    EXPECT_GT(lit, kTiles * kTileTexels / 2);
}

}  // namespace
}  // namespace ag
