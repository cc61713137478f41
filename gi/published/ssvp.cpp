#include "gi/published/ssvp.h"

#include <algorithm>

#include "shaders/published/ssvp/ssvp_io.h"

namespace ag::gi {
namespace {

struct Clustered {
    BufferHandle first;     // io::Val
    BufferHandle clusters;  // io::SsvpCluster
    BufferHandle owners;    // uint a light
};

Clustered addClusters(GraphScope scope, const RsmSet& rsm, uint32_t firstCount, uint32_t clusterCount,
                      uint32_t rounds) {
    Clustered c;
    c.first = scope.buffer("ssvp.first", {.sizeBytes = firstCount * sizeof(io::Val)});
    scope.compute("ssvp.sample_first", "published/ssvp/sample_first.comp")
        .read("texels", rsm.texels)
        .read("faces", rsm.faces)
        .read("maps", rsm.maps)
        .write("vpls", c.first)
        .push(glm::uvec3(firstCount, rsm.atlas.size.x, rsm.atlas.mapCount))
        .dispatchThreads(firstCount);
    const HistoryBuffer clusters =
        scope.historyBuffer("ssvp.clusters", {.sizeBytes = clusterCount * sizeof(io::SsvpCluster)});
    c.clusters = clusters.current;
    c.owners = scope.buffer("ssvp.owners", {.sizeBytes = firstCount * sizeof(uint32_t)});
    scope.compute("ssvp.cluster", "published/ssvp/cluster_vpls.comp")
        .read("vpls", c.first)
        .readPrevious("before", clusters)
        .write("clusters", c.clusters)
        .write("owners", c.owners)
        .push(glm::uvec4(firstCount, clusterCount, rounds, clusters.valid))
        .dispatchGroups(1);
    return c;
}

Paraboloids allocateMaps(GraphScope scope, BufferHandle clusters, uint32_t clusterCount, uint32_t mapSize) {
    const uint32_t columns = std::min(clusterCount, io::kSsvpMapColumns);
    const glm::uvec2 size =
        glm::uvec2(columns, (clusterCount + io::kSsvpMapColumns - 1) / io::kSsvpMapColumns) * mapSize;
    return {scope.image("ssvp.positions", {.format = VK_FORMAT_R32G32B32A32_SFLOAT, .size = size}),
            scope.image("ssvp.normals", {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = size}),
            scope.image("ssvp.albedos", {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = size}),
            scope.image("ssvp.depth", {.format = VK_FORMAT_D32_SFLOAT, .size = size}),
            clusters,
            clusterCount,
            mapSize};
}

}  // namespace

Ssvp addSsvp(GraphScope scope, const RsmSet& rsm, uint32_t firstCount, const SsvpSettings& s,
             DrawParaboloids draw) {
    if (rsm.empty()) return {};
    firstCount = std::min(firstCount, io::kMostSsvpVpls);
    const uint32_t clusterCount = std::clamp(s.clusters, 1u, io::kMostSsvpClusters);
    const Clustered c = addClusters(scope, rsm, firstCount, clusterCount, s.rounds);
    const Paraboloids maps = allocateMaps(scope, c.clusters, clusterCount, s.mapSize);
    draw(scope, maps);
    Ssvp result{.firstCount = firstCount};
    result.maps = {
        .mapCount = clusterCount, .tileSize = s.mapSize, .mapping = IsmMapping::kParaboloid, .shared = true};
    result.maps.planes =
        scope.buffer("ssvp.planes", {.sizeBytes = uint64_t(clusterCount) * s.mapSize * s.mapSize * 16,
                                     .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT});
    scope.compute("ssvp.resolve_depths", "published/ssvp/resolve_depths.comp")
        .sample("positions", maps.position)
        .read("clusters", c.clusters)
        .write("planes", result.maps.planes)
        .push(s.mapSize)
        .dispatchThreads(s.mapSize * s.mapSize, clusterCount);
    result.vals = allocateVals(scope, "ssvp.vals", "ssvp.shapes", firstCount + s.secondCount);
    struct Push {
        uint32_t firstCount, secondCount, valCount, clusterCount, mapSize;
    };
    scope.compute("ssvp.list_vpls", "published/ssvp/list_vpls.comp")
        .read("first", c.first)
        .read("clusters", c.clusters)
        .read("owners", c.owners)
        .sample("positions", maps.position)
        .sample("normals", maps.normal)
        .sample("albedos", maps.albedo)
        .write("vals", result.vals.vals)
        .write("shapes", result.vals.shapes)
        .constant("kDisk", s.disk)
        .push(Push{firstCount, s.secondCount, result.vals.count, clusterCount, s.mapSize})
        .dispatchThreads(result.vals.count);
    return result;
}

}  // namespace ag::gi
