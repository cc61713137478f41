#pragma once

#include <cstdint>

namespace ag::reference {

// One stream of random numbers (a permuted congruential generator; O'Neill 2014).
struct Random {
    uint64_t state = 0;
    float next() {  // in [0, 1)
        state = state * 6364136223846793005ull + 1442695040888963407ull;
        const auto word = uint32_t((state ^ (state >> 22)) >> (22 + (state >> 61)));
        return float(word >> 8) / 16777216.0f;
    }
};

}  // namespace ag::reference
