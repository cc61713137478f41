// A sun's reflective shadow map of a large scene in levels, as clipmaps (Tanner et al. 1998): one map over
// all of it, another over a quarter of its width about the camera, and so on until texels are as fine as what
// the camera sees asks for. Each is left out of the one about it, so that no surface is in two.
#pragma once

#include <array>
#include <span>

#include "gi/inputs.h"
#include "gi/light_views.h"
#include "shaders/gbuffer/view_points_io.h"
#include "shaders/rsm/rsm_io.h"

namespace ag::gi {

constexpr uint32_t kSunLevelRatio = 4;  // from one level's width to the next one's

// What the levels are made for.
struct SunFocus {
    glm::vec3 eye{0};    // m
    float distance = 0;  // m, of what the camera sees in the median; 0: not known, one level
};

// What is read back is some frames old, and may be about another origin than the camera is now.
struct SunFocusHistory {
    SunFocus focus;
    std::array<glm::vec3, kFramesInFlight> eyes{};  // of those frames, the oldest first
    uint32_t known = 0;                             // of `eyes`, the last ones
};

// What lives on the CPU from frame to frame.
struct SunLevelsHistory {
    float distance = 0;  // m, that the levels are made for: it stays while the focus' is near
    // Of the first sun: where each level begins in the one about it, in texels of that.
    std::array<glm::ivec2, io::kMostSunLevels> begins{};
    uint32_t known = 0;  // of `begins`
};

struct SunLevel {
    LightView view;
    glm::uvec2 holeBegin{0};  // texels, of the part that the next level has
    uint32_t holeSize = 0;    // 0: there is none
};

// `viewPoints`: as they were kFramesInFlight frames ago, or none. Keeps the distance where few show a
// surface.
SunFocus followFocus(std::span<const std::byte> viewPoints, glm::vec3 eye, SunFocusHistory& history);

// The distance to make levels for.
float steadyDistance(float distance, float before);

// The widest first. `size`: texels along each one's side; `detail`: of the distance, what a texel should
// span.
std::span<const SunLevel> layOutSunLevels(const LightView& whole, uint32_t size, const SunFocus& focus,
                                          float detail, SunLevelsHistory& history,
                                          std::array<SunLevel, io::kMostSunLevels>& levels);

}  // namespace ag::gi
