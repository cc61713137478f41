// Pixels that one pass leaves to a later one, which is dispatched for those alone. Written by `listPixel` of
// shaders/common/pixel_list.glsl, 64 pixels a workgroup.
#pragma once

#include <glm/glm.hpp>
#include <string_view>

#include "engine/frame/frame_graph.h"

namespace ag::gi {

struct PixelList {
    BufferHandle pixels;  // uint count, then uint x | y << 16 each
    BufferHandle groups;  // what dispatchIndirect takes
};

// Passes and resources; literals, because the graph keeps views of them.
struct PixelListNames {
    std::string_view pixels, noPixels, groups, noGroups;
};

// The same of anything else an uint can name; how many is counted by the groups alone.
struct WorkList {
    BufferHandle items;   // uint each; also a texel buffer
    BufferHandle groups;  // what dispatchIndirect takes
};
struct WorkListNames {
    std::string_view items, groups, noGroups;
};

// An empty list for at most so many; `none`: the groups dispatched for it.
WorkList addWorkList(GraphScope scope, const WorkListNames& names, uint32_t most, glm::uvec3 none);

// An empty list for at most every pixel of an image of `size`.
PixelList addPixelList(GraphScope scope, const PixelListNames& names, glm::uvec2 size);

}  // namespace ag::gi
