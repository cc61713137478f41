// Where to look from, and what sun to add, when a scene says neither: so that something lit is seen at once.
#pragma once

#include <optional>

#include "engine/scene/static_scene.h"

namespace ag::workbench {

struct FirstSight {
    CameraPose pose;
    RenderLight sun;     // the one that lights most of what the pose sees, 30 to 75 degrees above the horizon
    float litShare = 0;  // of what is seen: lit by that sun
};

// A scene that surrounds places where one can stand is seen from within, along its long sights; any other
// from outside, whole. `given`: the pose, where it is known already. `needsSun` false: the sun is not chosen.
FirstSight chooseFirstSight(const RenderScene& scene, const std::optional<CameraPose>& given, bool needsSun);

}  // namespace ag::workbench
