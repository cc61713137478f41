#include "tools/viewer/edit_history.h"

#include <utility>

namespace ag::viewer {

void EditHistory::note(EditState now, bool held) {
    const bool changed = std::exchange(begun_, true) && now != last_;
    if (changed && !editing_) {
        before_.push_back(last_);
        after_.clear();
    }
    editing_ = held && (editing_ || changed);
    last_ = std::move(now);
}

bool EditHistory::step(std::vector<EditState>& from, std::vector<EditState>& to, EditState& state) {
    if (from.empty()) return false;
    to.push_back(std::exchange(state, std::move(from.back())));
    from.pop_back();
    last_ = state;
    editing_ = false;
    return true;
}

}  // namespace ag::viewer
