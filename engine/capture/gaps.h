// Stretches of a frame in which the processor or the device did nothing for it, and what they waited for.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/capture/capture.h"

namespace ag::capture {

struct Gap {
    enum class Of { kFrameLoop, kDevice } of = Of::kDevice;
    uint64_t beginNs = 0, endNs = 0;
    std::string why;  // a sentence
};

// Of frame `index`, in order of time: what is longer than a fiftieth of the frame and than 50 us. Gaps of the
// device begin with the end of the frame before.
std::vector<Gap> gapsOf(std::span<const Frame> frames, size_t index);

}  // namespace ag::capture
