// The part of the viewer's panel that edits the scene: what was clicked, its material, the sky's sun.
#pragma once

#include "tools/viewer/selection.h"

namespace ag::viewer {

// Within the panel's ImGui window.
void sceneFields(Selection& selection, Viewing& viewing, const EditedScene& edited, float step);

}  // namespace ag::viewer
