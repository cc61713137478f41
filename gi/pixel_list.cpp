#include "gi/pixel_list.h"

namespace ag::gi {
namespace {

BufferHandle addGroups(GraphScope scope, std::string_view name, std::string_view noGroups, glm::uvec3 none) {
    const BufferHandle groups = scope.buffer(name, {.sizeBytes = sizeof(none), .indirect = true});
    scope.upload(noGroups, groups, std::as_bytes(std::span(&none, 1)));
    return groups;
}

}  // namespace

WorkList addWorkList(GraphScope scope, const WorkListNames& names, uint32_t most, glm::uvec3 none) {
    return {.items = scope.buffer(names.items,
                                  {.sizeBytes = most * sizeof(uint32_t), .texelFormat = VK_FORMAT_R32_UINT}),
            .groups = addGroups(scope, names.groups, names.noGroups, none)};
}

PixelList addPixelList(GraphScope scope, const PixelListNames& names, glm::uvec2 size) {
    const uint64_t most = uint64_t(size.x) * size.y;
    const PixelList list{.pixels = scope.buffer(names.pixels, {.sizeBytes = (1 + most) * sizeof(uint32_t)}),
                         .groups = addGroups(scope, names.groups, names.noGroups, {0, 1, 1})};
    scope.fill(names.noPixels, list.pixels, 0);
    return list;
}

}  // namespace ag::gi
