#include "gi/pixel_list.h"

namespace ag::gi {

PixelList addPixelList(FrameGraph& graph, const PixelListNames& names, glm::uvec2 size) {
    const uint64_t most = uint64_t(size.x) * size.y;
    const PixelList list{
        .pixels = graph.buffer(names.pixels, {.sizeBytes = (1 + most) * sizeof(uint32_t)}),
        .groups = graph.buffer(names.groups, {.sizeBytes = sizeof(glm::uvec3), .indirect = true})};
    graph.fill(names.noPixels, list.pixels, 0);
    const glm::uvec3 none(0, 1, 1);
    graph.upload(names.noGroups, list.groups, std::as_bytes(std::span(&none, 1)));
    return list;
}

}  // namespace ag::gi
