// The game's sounds to the machine's loudspeakers, if it has any and the player wants to hear them.
#pragma once

#include "engine/scene/static_scene.h"
#include "game/sounds.h"

namespace ag::game {

class Speaker {
  public:
    // 0 to 1; a device is open only while it is over 0. One that cannot be had is told of once.
    void setVolume(float volume);
    void play(std::span<const Sound> sounds);
    void listenFrom(const CameraPose& eyes);
    // The room's own sound, after so much time; -1: none.
    void standIn(int32_t room, float seconds);

  private:
    void open();

    std::unique_ptr<Mixer> mixer_;  // null: silence
    float volume_ = 0;
    uint32_t rooms_ = 0;   // that have a sound of their own
    bool toldOf_ = false;  // that there is no device
};

}  // namespace ag::game
