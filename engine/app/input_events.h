// What keys and mouse did, in its order, cut into frames: a click or a drag within one slow frame counts like
// a slow one.
#pragma once

#include <deque>
#include <glm/vec2.hpp>
#include <utility>
#include <variant>
#include <vector>

namespace ag {

struct KeyPress {
    int code = 0;  // of Bindings; 0: a gamepad's button that does nothing by itself
    bool control = false;
    int pad = 0;  // the code of a gamepad's button; `code` is then the key it stands for in menus
};

struct Pointer {
    glm::vec2 place{0};    // pixels from the window's upper left corner
    uint32_t buttons = 0;  // those held down, a bit each
};

class InputEvents {
  public:
    void key(KeyPress key) { waiting_.push_back(key); }
    void move(glm::vec2 place) { waiting_.push_back(place); }
    void button(int button, bool down);

    // A frame sees keys first, then where the mouse went, then one change of its buttons; what comes later
    // waits for the next frame, so that whoever reads the frame in this order misses nothing and turns
    // nothing round.
    void beginFrame();
    const Pointer& pointer() const { return pointer_; }
    std::vector<KeyPress> takeKeys() { return std::exchange(keys_, {}); }

  private:
    struct ButtonChange {
        uint32_t bit;
        bool down;
    };
    std::deque<std::variant<KeyPress, glm::vec2, ButtonChange>> waiting_;
    std::vector<KeyPress> keys_;
    Pointer pointer_;
};

}  // namespace ag
