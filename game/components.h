// Components of the level's own things.
#pragma once

#include <glm/glm.hpp>

#include "engine/ecs/entity.h"

namespace ag::game {

struct Collider {           // an upright box the player walks round
    glm::vec2 halfSize{0};  // m, along x and z before turning
};

struct Flicker {             // of a light: another strength each turn, or none
    glm::vec3 intensity{0};  // W/sr when it burns fully
    float depth = 0;         // part of it that comes and goes, 0 to 1
    float period = 1;        // s between turns
    float off = 0;           // part of the turns in which it is off, 0 to 1
    uint32_t seed = 0;       // no two alike
};

struct HandLamp {
    float yaw = 0, pitch = 0;  // rad, relative to the player's view
};

// Resources
struct Player {
    glm::dvec3 position{0};    // m, of the eyes
    float yaw = 0, pitch = 0;  // rad; yaw 0 looks along -Z
    float verticalFov = 1;     // rad
};

struct Walkable {               // where the eyes may be
    glm::dvec2 min{0}, max{0};  // m, x and z
};

struct GameTime {
    uint64_t tick = 0;
    double seconds = 0;        // since the start, tick x step
    double step = 1.0 / 60.0;  // s
};

}  // namespace ag::game
