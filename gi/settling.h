// When a technique that converges over frames may rest.
#pragma once

#include <cstdint>

namespace ag::gi {

// Lives on the CPU from frame to frame.
struct Settling {
    uint64_t inputs = 0;
    uint32_t sinceChange = 0, step = 0;

    // Steps on while the inputs change and for `frames` after; then the number stays, and what depends on it
    // is skipped.
    uint32_t advance(uint64_t inputsNow, uint32_t frames) {
        const bool changed = inputs != inputsNow;
        inputs = inputsNow;
        sinceChange = changed ? 0 : sinceChange + 1;
        if (sinceChange <= frames) ++step;
        return step;
    }
};

}  // namespace ag::gi
