// Settings that trade time for error, one at a time, with what turning each down was measured to leave of the
// techniques' times and to make of the error.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace ag::capture {

struct Remainder {
    std::string_view technique;  // or one pass
    double share = 1;            // of its time
};

struct Lever {
    std::string_view setting;
    double by = 0.5;  // the value is multiplied by this, or grows by it; 0: is switched off
    bool adds = false;
    double limit = 0;  // no lower than this; of one that grows no higher
    double errorTimes = 1;
    std::string_view term;  // of light that the error was measured on
    std::array<Remainder, 7> left{};
};

std::span<const Lever> levers();

}  // namespace ag::capture
