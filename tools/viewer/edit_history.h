// What was done to the scene, to be undone.
#pragma once

#include <memory>
#include <vector>

#include "engine/scene/asset_edits.h"

namespace ag::viewer {

// All of the scene that can be edited.
struct EditState {
    std::vector<RenderLight> lights;
    std::shared_ptr<const Sky> sky;
    AssetEdits assets;

    bool operator==(const EditState&) const = default;
};

class EditHistory {
  public:
    // Once a frame. A drag of many frames is one edit: it goes on while the mouse or a field is held.
    void note(EditState now, bool held);
    // What was before the last edit, or after the last one undone. False: there is none.
    bool undo(EditState& state) { return step(before_, after_, state); }
    bool redo(EditState& state) { return step(after_, before_, state); }

  private:
    bool step(std::vector<EditState>& from, std::vector<EditState>& to, EditState& state);

    std::vector<EditState> before_, after_;
    EditState last_;  // seen
    bool begun_ = false, editing_ = false;
};

}  // namespace ag::viewer
