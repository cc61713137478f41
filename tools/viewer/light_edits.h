// What was done to the lights, to be undone.
#pragma once

#include <vector>

#include "engine/scene/render_scene.h"

namespace ag::viewer {

class LightEdits {
  public:
    // Once a frame. A drag of many frames is one edit: it goes on while the mouse or a field is held.
    void note(const std::vector<RenderLight>& now, bool held);
    // The lights before the last edit, or after the last one undone. False: there is none.
    bool undo(std::vector<RenderLight>& lights);
    bool redo(std::vector<RenderLight>& lights);

  private:
    std::vector<std::vector<RenderLight>> before_, after_;
    std::vector<RenderLight> last_;  // seen
    bool begun_ = false, editing_ = false;
};

}  // namespace ag::viewer
