#include "tools/viewer/light_edits.h"

#include <utility>

namespace ag::viewer {

void LightEdits::note(const std::vector<RenderLight>& now, bool held) {
    const bool changed = std::exchange(begun_, true) && now != last_;
    if (changed && !editing_) {
        before_.push_back(last_);
        after_.clear();
    }
    editing_ = held && (editing_ || changed);
    last_ = now;
}

bool LightEdits::undo(std::vector<RenderLight>& lights) {
    if (before_.empty()) return false;
    after_.push_back(std::exchange(lights, std::move(before_.back())));
    before_.pop_back();
    last_ = lights;
    editing_ = false;
    return true;
}

bool LightEdits::redo(std::vector<RenderLight>& lights) {
    if (after_.empty()) return false;
    before_.push_back(std::exchange(lights, std::move(after_.back())));
    after_.pop_back();
    last_ = lights;
    editing_ = false;
    return true;
}

}  // namespace ag::viewer
