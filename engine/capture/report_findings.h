// What the report says of a frame in words: what would make it faster, its gaps, what was made anew.
#pragma once

#include <nlohmann/json.hpp>

#include "engine/capture/capture.h"

namespace ag::capture {

// {"advice": [sentence], "gaps": [{"lane", "begin", "end" (ns of the host's clock), "why"}], "anew":
// [sentence]}
nlohmann::ordered_json findingsJson(const Capture& capture, size_t frame);

}  // namespace ag::capture
