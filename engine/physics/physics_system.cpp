#include "engine/physics/physics_system.h"

#include <algorithm>
#include <cmath>

namespace ag {
namespace {

bool update(BodyState& state, const BodyPose& pose) {
    const bool rests = state.position == pose.position && state.rotation == pose.rotation &&
                       state.previousPosition == pose.position && state.previousRotation == pose.rotation &&
                       state.awake == uint32_t(pose.awake);
    if (rests) return false;
    state.previousPosition = state.position;
    state.previousRotation = state.rotation;
    state.position = pose.position;
    state.rotation = pose.rotation;
    state.velocity = pose.velocity;
    state.awake = pose.awake;
    return true;
}

BodyState newState(const BodyPose& pose, BodyId body) {
    BodyState state;
    state.position = state.previousPosition = pose.position;
    state.rotation = state.previousRotation = pose.rotation;
    state.body = body;
    return state;
}

// Of bodies without a state, in storage order: Bullet's order is part of the result.
std::vector<Entity> newBodies(World& world) {
    std::vector<Entity> found;
    View<const Body, const LocalTransform, Without<BodyState>>(world, {}).each(
        [&](Entity entity, const Body&, const LocalTransform&) { found.push_back(entity); });
    return found;
}

}  // namespace

void setUpPhysics(World& world, glm::dvec3 origin) {
    world.setResource<Physics>().world = std::make_unique<PhysicsWorld>(origin);
}

void makeBodies(World& world) {
    Physics& physics = world.resource<Physics>();
    std::erase_if(physics.bodies, [&](const auto& known) {
        if (world.has<Body>(known.first)) return false;
        physics.world->remove(known.second);
        return true;
    });
    if (View<const Body, Without<BodyState>>(world, {}).count() == 0) return;
    for (const Entity entity : newBodies(world)) {
        const LocalTransform& local = *world.get<LocalTransform>(entity);
        const BodyId body = physics.world->add(*world.get<Body>(entity), local.translation, local.rotation);
        if (const Hinge* hinge = world.get<Hinge>(entity)) physics.world->addHinge(body, *hinge);
        physics.bodies.push_back({entity, body});
        world.add(entity, newState(physics.world->pose(body), body));
    }
}

void stepPhysics(View<const Body, BodyState> bodies, Lookup<const LocalTransform> transforms,
                 Res<Physics> physics) {
    bodies.each([&](Entity entity, const Body& body, BodyState& state) {
        if (body.kind == BodyKind::kKinematic)
            if (const LocalTransform* local = transforms(entity))
                physics->world->moveTo(state.body, local->translation, local->rotation);
        return false;
    });
    physics->world->step(physics->tick);
    bodies.each([&](const Body& body, BodyState& state) {
        return body.kind != BodyKind::kStatic && update(state, physics->world->pose(state.body));
    });
}

void placeBodies(View<LocalTransform, const Body, const BodyState> bodies, Res<const Physics> physics) {
    bodies.each([&](LocalTransform& local, const Body& body, const BodyState& state) {
        if (body.kind != BodyKind::kDynamic) return false;
        const glm::dvec3 position =
            physics->share >= 1 ? state.position
                                : glm::mix(state.previousPosition, state.position, double(physics->share));
        const glm::quat rotation = physics->share >= 1
                                       ? state.rotation
                                       : glm::slerp(state.previousRotation, state.rotation, physics->share);
        if (local.translation == position && local.rotation == rotation) return false;
        local.translation = position;
        local.rotation = rotation;
        return true;
    });
}

// At the lowest point it gets the speed it needs to come as high as it should.
void keepPendulums(View<const Pendulum, const Hinge, const Body, const BodyState> pendulums,
                   Res<Physics> physics) {
    pendulums.each([&](const Pendulum& p, const Hinge& hinge, const Body& body, const BodyState& state) {
        const glm::vec3 axis = state.rotation * hinge.axis;
        const float swing = glm::dot(physics->world->spin(state.body), axis);
        const glm::vec3 arm = state.rotation * (body.center - hinge.pivot);
        const float length = glm::length(arm), lean = std::acos(std::clamp(-arm.y / length, -1.0f, 1.0f));
        if (lean > 0.12f) return;
        const float wanted = std::sqrt(2 * kGravity * (1 - std::cos(p.amplitude)) / length);
        const float sign = swing < 0 ? -1.0f : 1.0f;
        physics->world->setVelocity(state.body, glm::cross(axis, arm) * (sign * wanted),
                                    axis * (sign * wanted));
    });
}

}  // namespace ag
