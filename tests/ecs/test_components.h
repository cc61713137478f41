// Components and resources the tests of the ECS share.
#pragma once

#include "engine/ecs/entity.h"

namespace ag {

struct Position {
    float x = 0, y = 0, z = 0;
    bool operator==(const Position&) const = default;
};
struct Velocity {
    float x = 0, y = 0, z = 0;
};
struct Health {
    int32_t points = 100;
    bool operator==(const Health&) const = default;
};
struct Frozen {
    uint32_t since = 0;
};
struct Streamed {
    float value = 0;
};
template <>
inline constexpr bool kTrackRows<Streamed> = true;

struct Copied {  // tracked, too
    float value = 0;
};
template <>
inline constexpr bool kTrackRows<Copied> = true;

struct Clock {
    float seconds = 0.1f;
};
struct Score {
    int total = 0;
};

struct Marked {};  // a tag

}  // namespace ag
