// The text of a saved game, line by line. Knows no world.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "engine/core/result.h"

namespace ag::game {

struct SavedRoom {
    int32_t index = 0;
    float since = 0;
};
struct SavedFlower {
    uint32_t node = 0;
    float openness = 0;
};
struct SavedBody {
    uint32_t node = 0;
    glm::dvec3 position{0};
    glm::quat rotation{1, 0, 0, 0};
};
struct SavedTime {  // spent in a room before it was solved
    int32_t room = 0;
    double seconds = 0;
};
struct Saved {
    glm::dvec3 feet{0};
    float yaw = 0, pitch = 0;
    std::vector<SavedRoom> rooms;
    std::vector<SavedFlower> flowers;
    std::vector<SavedBody> bodies;
    bool timed = false;  // it says how long was played
    double played = -1;  // s since the level's start; negative: not known
    std::vector<SavedTime> times;
    bool won = false;
};

// What a save of a level may say.
struct SaveLimits {
    uint64_t level = 0;                 // a hash of the level's things
    glm::dvec3 least{-1e6}, most{1e6};  // m, of places
    uint32_t nodes = 0;
    int32_t mostRoom = -1;
};

// Its first two lines.
std::string saveHead(uint64_t level);
// The error names the file and the line that is damaged.
Result<Saved> parseSave(const std::string& text, const std::string& path, const SaveLimits& limits);

}  // namespace ag::game
