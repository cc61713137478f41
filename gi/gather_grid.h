// Which pixel of each square of spacing x spacing light is gathered at. While nothing changes it is one after
// another, each for as long as its rays to texels settle: a still picture ends with light of every pixel's
// own.
#pragma once

#include "gi/settings.h"

namespace ag::gi {

struct GatherGrid {
    glm::uvec2 place{0};  // of the pixel in its square
    uint32_t turn = 0;    // how many of the square's pixels were before it
    bool begins = false;  // its first frame
    bool still = false;   // rays are cast, or were: nothing has changed since the frame before
    bool grows = false;   // later bounces still add light
    uint64_t change = 0;  // number of the last change
    uint32_t frames = 0;  // in which it casts rays
};

// Of what casts rays at the grid's pixels, and steps on by `settling`: the number of the frame's rays, unlike
// that of any other frame and turn since the last change. A still picture does not depend on what was before
// that.
uint32_t rayNumber(const GatherGrid& grid, const Settling& settling);
// Frames that a mean of rays stands for, `most` at most: few while later bounces add light.
float meanLength(const GatherGrid& grid, uint32_t most);
// Share of what rays found before the last change that stays, a frame, while new rays are not sure yet. Later
// turns keep what the first one found.
float keptShare(const GatherGrid& grid);

// Lives on the CPU from frame to frame.
struct GatherGridHistory {
    Settling settling;             // of the pixels' light
    Settling light;                // of what it depends on, but where in the pixels surfaces are sampled
    BounceLightSettings settings;  // of the frame before
    uint64_t changes = 0;          // of settings
    uint64_t restarts = 0;         // by whatever changed
};

// Of a scene in which rays are cast: frames from the last change on until nothing is made anew, at most (less
// without a sky).
uint32_t framesToRest(const BounceLightSettings& settings);

// `light`: of all that light depends on but the settings and `camera`, which anti-aliasing moves within a
// pixel. Without rays the middle pixel has all turns.
GatherGrid chooseGatherGrid(uint64_t light, uint64_t camera, bool castsRays,
                            const BounceLightSettings& settings, GatherGridHistory& history);

}  // namespace ag::gi
