// Components of the level's own things.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/ecs/entity.h"
#include "engine/physics/character.h"
#include "engine/scene/static_scene.h"

namespace ag::game {

struct Flicker {             // of a light: another strength each turn, or none
    glm::vec3 intensity{0};  // W/sr when it burns fully
    float depth = 0;         // part of it that comes and goes, 0 to 1
    float period = 1;        // s between turns
    float off = 0;           // part of the turns in which it is off, 0 to 1
    uint32_t seed = 0;       // no two alike
};

struct HandLamp {
    float yaw = 0, pitch = 0;  // rad, relative to the player's view
    float focus = 3;           // m before the eyes, where its beam meets the view's middle
};

enum class FlowerMood : uint32_t {
    kDark,     // too little bounced light to tell its colour
    kWrong,    // light of another colour
    kThirsty,  // the right colour, not enough
    kGrowing,
    kBlinded,  // direct light: it closes
    kOpen,     // for good: its room is solved
    kDazzled,  // a shy one: light of any kind
};

// m above a flower's foot: just over its closed petals, where light is asked for.
constexpr float kFlowerHead = 0.70f;

struct Flower {
    glm::vec3 wants{1};  // colour, greatest channel 1
    float amount = 0;    // W/m², mean of the channels
    int32_t room = 0;
    float openness = 0;  // 0 to 1
    FlowerMood mood = FlowerMood::kDark;
    float received = 0;    // W/m² of bounced light
    float match = 0;       // cosine between its colour and the light's
    uint32_t bloomed = 0;  // was fully open, and has not wilted far since
    float promise = 0;     // how near its light is to opening it, 0 to 1: at 1 it grows
    uint32_t shy = 0;      // opens in the dark: `amount` is the most it bears
};

struct Petal {
    Entity flower;
    glm::quat closed{1, 0, 0, 0};
};

// The glow between its petals: as large as its light is good.
struct FlowerHeart {
    Entity flower;
};

struct Lantern {  // a light or a flame that wakes when its room is solved
    int32_t room = 0;
    float delay = 0;         // s after that
    glm::vec3 intensity{0};  // W/sr awake
};

struct Door {
    glm::dvec3 closed{0};  // m
    float height = 0;      // m
    int32_t room = 0;      // whose flowers open it
};

struct Room {
    glm::dvec3 center{0};  // m
    glm::vec3 half{0};     // m
    int32_t index = 0;
    uint32_t flowers = 0, open = 0;
    uint32_t solved = 0;
    float since = 0;  // s since it was solved
    uint32_t openToSky = 0;
    uint32_t unused = 0;
};

struct Crate {
    uint32_t carried = 0;
};

// Resources
struct Player {
    Character body;
    float yaw = 0, pitch = 0;    // rad; yaw 0 looks along -Z
    float eyeHeight = 1.62f;     // m, follows crouching smoothly
    glm::dvec3 position{0};      // m, of the eyes after the last tick
    glm::dvec3 before{0};        // and after the one before
    float verticalFov = 1;       // rad
    Entity carried;              // a crate in the hands
    uint32_t buttonsBefore = 0;  // of the last tick
};

struct Hint {
    glm::dvec3 position{0};
    int32_t room = 0;
    std::string text;
    bool isRule = false;  // the room's own sentence, shown from the start
};

struct Progress {
    int32_t room = -1;  // the player is in, or was last; -1: none yet
    uint32_t roomsSolved = 0, rooms = 0;
    uint32_t flowersOpen = 0, flowers = 0;
    uint32_t won = 0;  // the last room was reached with all flowers open
    float idle = 0;    // s since a flower opened further or another room was entered
    float best = 0;    // openness of this room's flowers together, the most it has been
};

// Eyes that are not the player's: what is seen is seen from there.
struct FreeEyes {
    bool open = false;
    CameraPose pose;
};

// How long it took so far, s of the world's time.
struct PlayTime {
    bool known = true;          // false: it went on from somewhere
    double whole = 0;           // since the level's start
    std::vector<double> rooms;  // spent in each before it was solved, by index
};

struct GameTime {
    uint64_t tick = 0;
    double seconds = 0;        // since the start, tick x step
    double step = 1.0 / 60.0;  // s
};

}  // namespace ag::game
