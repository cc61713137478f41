// Blue noise by void and cluster (Ulichney 1993): an ordering of a torus's pixels in which every beginning is
// spread evenly.
#pragma once

#include <cstdint>
#include <vector>

namespace ag::noise {

// Rank of each pixel of a square of `side` pixels, 0 to side² - 1, rows from the top. Equal seeds give equal
// ranks.
std::vector<uint32_t> voidAndCluster(uint32_t side, uint32_t seed);

}  // namespace ag::noise
