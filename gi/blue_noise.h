// Blue noise, 64 x 64 pixels of two independent numbers from 0 to 1; made at build time by tools/noise.
#pragma once

#include "engine/frame/frame_graph.h"

namespace ag::gi {

// A texel buffer of rg16 unorm, rows from the top.
BufferHandle addBlueNoise(GraphScope scope);

}  // namespace ag::gi
