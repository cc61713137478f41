// Somebody on foot: a capsule that walks, jumps, crouches, climbs steps and slides along what it meets, and
// pushes what gives way. Moved by sweeps, not by forces, so that it stops where the keys say.
#pragma once

#include "engine/physics/physics_world.h"

namespace ag {

struct CharacterSettings {
    float radius = 0.3f, height = 1.75f, crouchHeight = 1.0f;  // m
    float speed = 3.4f, crouchSpeed = 1.6f;                    // m/s
    float acceleration = 30, airAcceleration = 6;              // m/s²
    float jumpHeight = 0.8f;                                   // m
    float stepHeight = 0.32f;                                  // m, climbed without a jump
    float steepest = 0.64f;                                    // cosine of the steepest slope that carries
    float pushForce = 260;                                     // N
    float pushSpeed = 1.4f;                                    // m/s, of what is pushed, at most
};

struct Character {
    glm::dvec3 feet{0};     // m
    glm::vec3 velocity{0};  // m/s
    float height = 1.75f;   // m now
    uint32_t grounded = 0, crouched = 0;
    BodyId walker = kNoBody;
};

struct CharacterIntent {
    glm::vec2 way{0};  // along x and z, length 1: full speed
    bool jump = false, crouch = false;
};

void moveCharacter(PhysicsWorld& physics, Character& character, const CharacterIntent& intent,
                   const CharacterSettings& settings, float seconds);

}  // namespace ag
