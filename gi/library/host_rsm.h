// Reflective shadow maps that the host draws itself.
#pragma once

#include "gi/library/scene_on_device.h"
#include "gi/rsm.h"

namespace ag::guest {

// Declares the pass that calls the frame's drawRsmFace for each face of each light.
void addHostRsm(GraphScope scope, const SceneOnDevice& device, const AgiFrame& frame, gi::RsmSet& rsm);

}  // namespace ag::guest
