// A player who aims badly: within 10° of the flowers of a room and of what is beside them, now from far, now
// from near, and grasps at whatever is there.
#pragma once

#include <random>

#include "tests/play/stage/bot.h"

namespace ag::game {

class BadPlayer {
  public:
    // In the room where the stage's player stands.
    BadPlayer(Stage& stage, uint32_t seed);
    ~BadPlayer();

    void play(int ticks);
    // Ticks in which a flower opened further, or bloomed, while the lamp or another beam shone on it.
    int openedByDirectLight() const { return wrong_; }
    int ticksOfDirectLight() const { return direct_; }
    // Lets go of everything and walks: whether it gets away from where it stands, on the floor.
    bool canLeave();

  private:
    void check();
    void aimNear(glm::dvec3 place);
    double random(double least, double most);

    Stage& stage_;
    Bot bot_;
    std::mt19937 random_;
    int32_t room_ = 0;
    std::vector<Flower> before_;
    int wrong_ = 0, direct_ = 0;
};

}  // namespace ag::game
