// A player that follows a script: walks to places, looks at things, waits for flowers. What it pressed is the
// recording.
#pragma once

#include <string>
#include <vector>

#include "tests/play/stage/stage.h"

namespace ag::game {

class Bot {
  public:
    explicit Bot(Stage& stage, bool tells = false) : stage_(stage), tells_(tells) {}

    // In a straight line; gives up after as many ticks. `tolerance`: m.
    bool walk(double x, double z, int mostTicks = 400, double tolerance = 0.12);
    // From now on at this place, wherever it walks; turns there first.
    void look(double x, double y, double z);
    void lookAhead() { looksAt_ = false; }
    bool waitForFlower(size_t index, int mostTicks = 420);
    bool waitForDoor(int room, int mostTicks = 300);
    void wait(int ticks);
    void press(uint32_t button);
    void hold(uint32_t buttons) { held_ = buttons; }

    const std::vector<Input>& inputs() const { return inputs_; }
    bool failed() const { return failed_; }

  private:
    void tick(glm::dvec2 way);
    glm::vec2 turn() const;
    bool fail(const std::string& what);

    Stage& stage_;
    std::vector<Input> inputs_;
    glm::dvec3 target_{0};
    bool looksAt_ = false, failed_ = false, tells_;
    glm::dvec2 heading_{0};
    uint32_t held_ = 0;
};

// Plays the shipped level from the start to the garden; false if something did not go as planned.
bool playWalkthrough(Bot& bot);
// The same from a room's entrance on.
bool playFrom(Bot& bot, int room);
// Three ways that do not open a flower: the beam on it (flower 0), light of another colour (flower 4), light
// on the wrong side of a wall (flower 1).
bool playDirectBeam(Bot& bot);
bool playWrongColour(Bot& bot);
bool playWallBetween(Bot& bot);

}  // namespace ag::game
