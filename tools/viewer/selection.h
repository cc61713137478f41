// What was clicked in the picture, and its handle.
#pragma once

#include "tools/viewer/edited_scene.h"
#include "tools/viewer/picking.h"
#include "tools/viewer/viewer.h"

namespace ag::viewer {

struct Selection {
    std::optional<uint32_t> thing;     // a node
    std::optional<uint32_t> material;  // of what was clicked
    bool held = false;                 // its handle is dragged
};

// Of the thing, to be changed; made if it has none.
NodeMove& moveOf(AssetEdits& edits, uint32_t node);
MaterialLook& lookOf(AssetEdits& edits, const GeometryArrays& geometry, uint32_t material);

// Within an ImGui frame, with the mouse free and not on a panel or a light's handle: selects what is clicked,
// draws the selected thing's box and handle beneath the panels, and moves it in the plane of the picture
// while the handle is held.
void dragThing(Selection& selection, Viewing& viewing, const EditedScene& edited, const Screen& screen);

}  // namespace ag::viewer
