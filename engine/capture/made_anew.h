// What a frame made anew and what each of it goes back to, in sentences: a pass that ran because something it
// reads had changed is followed to the pass or the data from outside where that began.
#pragma once

#include <string>
#include <vector>

#include "engine/frame/frame_description.h"

namespace ag::capture {

// One sentence a technique, in the order of the frame: "rsm (5 passes): the scene's lights changed."
std::vector<std::string> madeAnew(const FrameDescription& frame);

}  // namespace ag::capture
