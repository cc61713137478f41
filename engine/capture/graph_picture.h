// Graphs as SVG, laid out in columns without help from outside.
#pragma once

#include "engine/capture/capture.h"

namespace ag::capture {

// A column for each technique, passes in order from the top; an arrow from the pass that wrote something to
// those that read it. Green ran in the last frame, grey was skipped, white was dropped.
std::string frameGraphSvg(const Capture& capture);
// A column for each step that could start at the earliest; what stands in one column may overlap.
std::string scheduleSvg(const Capture& capture);

}  // namespace ag::capture
