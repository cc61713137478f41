// How much of a picture is nearly black or burnt out.
#pragma once

#include "engine/core/image.h"

namespace ag::game {

struct Extremes {
    float dark = 0, bright = 0;  // shares of its pixels
};

// Luminance of display values in [0, 1]: below 16 of 255 is dark, from 250 on bright.
Extremes extremesOf(const Image& picture);

constexpr float kMostDark = 0.25f, kMostBright = 0.03f;  // of a picture of the game

}  // namespace ag::game
