// Components of things with weight. A Body belongs to a root entity; its pose after each tick is BodyState,
// and LocalTransform follows between ticks for drawing. What decides about the game reads BodyState.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/ecs/entity.h"

namespace ag {

constexpr float kGravity = 9.81f;  // m/s², downwards

enum class BodyKind : uint32_t {
    kStatic,     // never moves
    kKinematic,  // goes where its LocalTransform is put, whatever stands there
    kDynamic,    // moved by forces
};

struct Body {  // a box about the entity's origin
    BodyKind kind = BodyKind::kStatic;
    glm::vec3 halfSize{0.5f};     // m
    glm::vec3 center{0};          // m, of the box, in the entity's frame; dynamic: also of its mass
    float mass = 10;              // kg, dynamic
    float friction = 0.6f;        // of Coulomb, multiplied with the other's
    float restitution = 0;        // 0 to 1
    float linearDamping = 0.05f;  // share of the speed lost in a second
    float angularDamping = 0.1f;
};

struct BodyState {           // written by stepPhysics
    glm::dvec3 position{0};  // m, of the entity's origin
    glm::quat rotation{1, 0, 0, 0};
    glm::quat previousRotation{1, 0, 0, 0};
    glm::dvec3 previousPosition{0};  // a tick ago
    glm::vec3 velocity{0};           // m/s
    uint32_t body = ~0u;             // in the PhysicsWorld
    uint32_t awake = 1;
    uint32_t unused[3] = {0, 0, 0};
};

// Turns about an axis through a fixed point: a panel by an upright one, a pendulum by a level one.
struct Hinge {
    glm::vec3 pivot{0};                // m, in the entity's frame
    glm::vec3 axis{0, 1, 0};           // in the entity's frame, unit
    float least = -1.5f, most = 1.5f;  // rad from where it was made; least > most: no limits
};

struct Pendulum {            // with a Hinge: its swing is kept up
    float amplitude = 0.6f;  // rad
};

}  // namespace ag
