// What a recording was made with and where it led. With the same it leads there again; with another device or
// quality flowers may read other light, and the world goes another way.
#pragma once

#include <string>

#include "game/demo_options.h"

namespace ag::game {

ReplayNotes replayNotes(const Demo& demo);
// Not of a replay of another level: there its steps mean nothing.
Status checkReplay(const Demo& demo);
// Once all of the replay was played: whether the world is the recording's, and if not, what was different.
// Empty where the replay does not say.
std::string replayVerdict(const Demo& demo);

}  // namespace ag::game
