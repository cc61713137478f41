// The buffer that most cases make.
#pragma once

#include "engine/frame/frame_graph.h"

namespace ag {

constexpr BufferInfo kBuffer{.sizeBytes = 1024};

}  // namespace ag
