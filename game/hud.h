// What stands over the picture: the room's goal, each flower's wish and what it gets, a hint, and marks over
// flowers. Each colour has a shape of its own, so that nothing is told by colour alone.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "engine/ecs/world.h"
#include "game/components.h"

namespace ag::game {

// A flower of the room the player is in.
struct FlowerLine {
    glm::vec3 wants{1}, received{0};  // of full bars, channel by channel
    float openness = 0, promise = 0;
    FlowerMood mood = FlowerMood::kDark;
    bool closing = false;    // light is missing, slowly
    bool grazed = false;     // direct light that hardly shows: the edge of a beam
    bool shy = false;        // wants darkness
    bool meant = false;      // the one the player is at: nearest to the middle of the view
    glm::dvec3 position{0};  // m, of its head
};

struct HudState {
    std::vector<FlowerLine> flowers;
    std::string goal, rule, hint, notice;  // rule: the room's own sentence
    std::vector<std::string> heard;        // subtitles of sounds
    bool carrying = false, crateInReach = false;
    bool legend = false;  // says how bars are read
};

enum class Shape : uint32_t { kCircle, kTriangle, kSquare, kDiamond, kStar, kCross, kHexagon };
Shape shapeOf(glm::vec3 wants);
const char* shapeName(Shape shape);
const char* moodText(const FlowerLine& flower);

constexpr float kHintSeconds = 40;  // without progress, before a hint is shown

HudState readHud(World& world, const std::vector<Hint>& hints, bool showHints);
// What the picture below is seen through.
struct HudView {
    glm::mat4 clipFromWorld{1};  // relative to the origin
    glm::dvec3 origin{0};        // m
};
// Within an ImGui frame, over a picture of `size` pixels.
void drawHud(const HudState& hud, glm::vec2 size, const HudView& view);

// In photo mode instead: lines at the top left, the keys at the bottom.
void drawPhotoLines(const std::vector<std::string>& lines, const std::string& keys, glm::vec2 size);

// A line at the top left, of the program rather than of the game; none if empty.
void drawMessage(const std::string& text);

}  // namespace ag::game
