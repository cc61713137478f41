// What the game sounds like: its tones by name. They are computed at the start; there are no files.
#pragma once

#include "engine/sound/mixer.h"

namespace ag::game {

enum class SoundId : uint32_t {
    kBloom,     // a flower is open
    kShut,      // direct light closes one
    kDoor,      // a door sinks
    kLanterns,  // a room's lanterns wake
    kFinished,  // the last room is reached
    kStep,
    kLanding,
    kPickUp,
    kPutDown,
    kKnock,  // bodies meet hard
    kClick,  // in the menu
};

// By SoundId.
std::vector<Tone> gameTones();
// What is heard in each room all the time, soft; by the room's index.
std::vector<Tone> roomTones();

struct SoundSettings {
    float volume = 0.7f;  // 0: no device is opened
};

Sound soundOf(SoundId id, float gain = 1, float pitch = 1);
Sound soundAt(glm::dvec3 position, SoundId id, float gain = 1, float pitch = 1);

}  // namespace ag::game
