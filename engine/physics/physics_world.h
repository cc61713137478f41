// Rigid bodies in ticks of fixed length, by Bullet, of which nothing shows here. The same calls in the same
// order give the same motion bit for bit. Positions are doubles about an origin near by, inside all is single
// precision.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/physics/components.h"

namespace ag {

using BodyId = uint32_t;
constexpr BodyId kNoBody = ~0u;

struct BodyPose {
    glm::dvec3 position{0};  // m, of the entity's origin
    glm::quat rotation{1, 0, 0, 0};
    glm::vec3 velocity{0};  // m/s
    bool awake = false;
};

struct BodyHit {
    BodyId body = kNoBody;
    float share = 1;         // of the way
    glm::vec3 normal{0};     // off the surface, unit
    glm::dvec3 position{0};  // m, where they touch
};

struct Capsule {                          // upright, standing at `feet`
    float radius = 0.3f, height = 1.75f;  // m, from end to end
};

class PhysicsWorld {
  public:
    explicit PhysicsWorld(glm::dvec3 origin = glm::dvec3(0));
    ~PhysicsWorld();
    PhysicsWorld(const PhysicsWorld&) = delete;
    PhysicsWorld& operator=(const PhysicsWorld&) = delete;

    BodyId add(const Body& body, glm::dvec3 position, glm::quat rotation);
    // A static mesh: triangles as they are in the world.
    BodyId addMesh(std::span<const glm::dvec3> positions, std::span<const uint32_t> indices);
    void addHinge(BodyId body, const Hinge& hinge);
    void remove(BodyId body);

    void step(float seconds);
    BodyPose pose(BodyId body) const;
    BodyKind kind(BodyId body) const;
    float mass(BodyId body) const;
    glm::vec3 spin(BodyId body) const;  // rad/s
    uint32_t awakeCount() const;        // dynamic bodies that do not rest
    uint32_t bodyCount() const;

    void moveTo(BodyId body, glm::dvec3 position,
                glm::quat rotation);  // kinematic; and wakes what it may touch
    void place(BodyId body, glm::dvec3 position, glm::quat rotation);  // at once, at rest
    void setVelocity(BodyId body, glm::vec3 linear, glm::vec3 angular);
    void push(BodyId body, glm::vec3 impulse, glm::dvec3 at);  // N s
    void setWeightless(BodyId body, bool weightless);

    // The upright capsule that others meet; its own sweeps pass through it.
    BodyId addWalker(Capsule capsule, glm::dvec3 feet);
    void moveWalker(BodyId walker, Capsule capsule, glm::dvec3 feet);
    // A carried body and the walker pass through each other.
    void setCarried(BodyId body, bool carried);

    // The first thing a capsule meets on its way; carried bodies and walkers are not there.
    std::optional<BodyHit> sweep(Capsule capsule, glm::dvec3 fromFeet, glm::dvec3 toFeet) const;
    std::optional<BodyHit> ray(glm::dvec3 from, glm::dvec3 to) const;
    // The way out of what the capsule stands in, m; zero if it is free.
    glm::vec3 wayOut(Capsule capsule, glm::dvec3 feet) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace ag
