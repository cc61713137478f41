// Things that slide and turn by the clock alone: the same time always finds them in the same place, on any
// machine and any number of threads.
#pragma once

#include "engine/ecs/view.h"
#include "engine/scene/components.h"

namespace ag {

struct Mover {             // slides to and fro along `extent` and turns about +Y
    glm::dvec3 origin{0};  // m, middle of the way
    glm::vec3 extent{0};   // m
    float period = 0;      // s, 0: does not slide
    float spinSpeed = 0;   // rad/s
    float startYaw = 0;    // rad
};

// sin(2 pi turns) within 2e-7, without the library's sine, which differs from machine to machine.
float sineOfTurns(double turns);

// Where a mover is at a time in seconds.
void place(const Mover& mover, double seconds, LocalTransform& local);
void moveAlong(View<LocalTransform, const Mover> movers, double seconds, JobRunner& runner);

}  // namespace ag
