#include "gi/cluster_members.h"

namespace ag::gi {
namespace {

BufferHandle uintBuffer(GraphScope scope, std::string_view name, uint64_t count) {
    return scope.buffer(name, {.sizeBytes = count * 4, .texelFormat = VK_FORMAT_R32_UINT});
}

}  // namespace

ClusterMembers addClusterMembers(GraphScope scope, const RsmSet& rsm, const Clusters& c) {
    const uint64_t texelCount = uint64_t(rsm.tileCount) * io::kRsmTileSize * io::kRsmTileSize;
    const ClusterMembers m{uintBuffer(scope, "cluster_members.ranges", 2 * c.count),
                           uintBuffer(scope, "cluster_members.texels", texelCount)};
    const BufferHandle ofTiles = uintBuffer(scope, "cluster_members.of_tiles", c.mostPartials);
    const glm::uvec2 push(c.count, rsm.tileCount);
    scope.compute("cluster_members.count", "cluster_members/count.comp")
        .read("clusters", c.clusters)
        .read("partialOf", c.partialOf)
        .read("partials", c.partials)
        .write("memberRanges", m.ranges)
        .write("tileMembers", ofTiles)
        .push(push)
        .dispatchGroups(c.count);
    scope.compute("cluster_members.list", "cluster_members/list.comp")
        .read("slotOfTexel", c.slotOfTexel)
        .read("candidates", c.candidates)
        .read("partialOf", c.partialOf)
        .read("tileMembers", ofTiles)
        .write("members", m.texels)
        .push(push)
        .dispatchGroups(rsm.tileCount);
    return m;
}

void readMembers(PassBuilder& pass, const ClusterMembers& members) {
    pass.read("memberRanges", members.ranges).read("members", members.texels);
}

}  // namespace ag::gi
