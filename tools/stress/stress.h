// What a renderer must stand: the cases of numerical stability as a table. Each case renders a scene that is
// hard in one way and holds it against the plain scene, or against what must be true; in each, no number may
// be none and the invariants of clustering must hold.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/function_ref.h"
#include "engine/gpu/device.h"

namespace ag::stress {

struct StressRow {
    std::string name;
    std::string measure;               // what `value` is, with its unit
    double value = 0, limit = 0;       // good up to and with the limit
    std::optional<std::string> fault;  // what else went wrong
    std::string note;                  // beside the row, for readers

    bool good() const { return !fault && value <= limit; }  // NaN is bad
};

struct StressOptions {
    std::string only;  // cases whose name holds this text; empty: all
    std::vector<std::string> scenes = {"cornell", "corridor", "lamps"};  // that are moved and scaled
    uint32_t frames = 32;                                                // of cases that stand still
    uint32_t movingFrames = 10'000;
    uint32_t mapResolution = 0;  // of RSMs; 0: as the lights say
    double mostGrowth = 8;       // MiB, in the second half of them
    bool twice = true;           // render cases that stand still again: the bits must be the same
};

// Rows in a fixed order, each as soon as it is known.
void runStress(gpu::Device& device, const StressOptions& options, FunctionRef<void(const StressRow&)> report);

}  // namespace ag::stress
