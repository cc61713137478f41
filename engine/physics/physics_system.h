// Physics as systems. A tick: makeBodies, what pushes and carries, stepPhysics. A frame between two ticks:
// placeBodies.
#pragma once

#include "engine/ecs/schedule.h"
#include "engine/physics/physics_world.h"
#include "engine/scene/components.h"

namespace ag {

struct Physics {  // resource
    std::unique_ptr<PhysicsWorld> world;
    std::vector<std::pair<Entity, BodyId>> bodies;  // of entities, alive at the last tick
    float tick = 1.0f / 60;                         // s
    float share = 1;  // of the way from the tick before to the last one, that is drawn
};

void setUpPhysics(World& world, glm::dvec3 origin);

// Bodies for what is new, none for what is gone. Runs alone.
void makeBodies(World& world);
// Kinematic bodies follow their transforms, the rest moves on by a tick.
void stepPhysics(View<const Body, BodyState> bodies, Lookup<const LocalTransform> transforms,
                 Res<Physics> physics);
// Dynamic bodies' transforms, between the ticks.
void placeBodies(View<LocalTransform, const Body, const BodyState> bodies, Res<const Physics> physics);
void keepPendulums(View<const Pendulum, const Hinge, const Body, const BodyState> pendulums,
                   Res<Physics> physics);

}  // namespace ag
