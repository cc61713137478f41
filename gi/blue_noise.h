// Blue noise, 64 x 64 pixels of two independent numbers from 0 to 1; made at build time by tools/noise.
#pragma once

#include "engine/frame/frame_graph.h"

namespace ag::gi {

// A texel buffer of rg16 unorm, rows from the top.
BufferHandle addBlueNoise(GraphScope scope);

// What a pixel's three numbers are shifted by in frame `step`, so that its frames are spread evenly:
// multiples of inverse powers of the root of x^4 = x + 1 (Roberts 2018).
glm::vec3 blueNoiseShift(uint32_t step);

}  // namespace ag::gi
