#include "engine/app/input_events.h"

#include "engine/app/bindings.h"

namespace ag {

void InputEvents::button(int button, bool down) {
    // As a key it can be bound to something. It says nothing of where the mouse is and need not wait for
    // that.
    if (down) waiting_.push_back(KeyPress{kMouseCode + button});
    waiting_.push_back(ButtonChange{1u << button, down});
}

void InputEvents::beginFrame() {
    for (bool moved = false, changed = false; !waiting_.empty() && !changed; waiting_.pop_front()) {
        if (const auto* key = std::get_if<KeyPress>(&waiting_.front())) {
            if (moved && key->code < kMouseCode) return;
            keys_.push_back(*key);
        } else if (const auto* place = std::get_if<glm::vec2>(&waiting_.front())) {
            pointer_.place = *place;
            moved = true;
        } else {
            const auto change = std::get<ButtonChange>(waiting_.front());
            pointer_.buttons = change.down ? pointer_.buttons | change.bit : pointer_.buttons & ~change.bit;
            changed = true;
        }
    }
}

}  // namespace ag
