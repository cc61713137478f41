#include "game/furnish_world.h"

#include <cmath>

#include "engine/physics/physics_system.h"
#include "engine/renderer/probe_components.h"
#include "engine/scene/mover.h"

namespace ag::game {
namespace {

struct Furnished {  // one node
    World& world;
    const SceneAsset& asset;
    const SceneNode& node;
    Entity entity;
};

// The box round a node's mesh, as a body.
Body bodyOf(const Furnished& f, BodyKind kind) {
    Bounds bounds;
    const SceneMesh& mesh = f.asset.meshes[size_t(f.node.mesh)];
    for (uint32_t p = 0; p < mesh.primitiveCount; ++p)
        bounds.add(f.asset.geometry.primitives[mesh.firstPrimitive + p].boundsLocal);
    const glm::vec3 scale = f.node.local.scale;
    return {.kind = kind,
            .halfSize = glm::max((bounds.max - bounds.min) * 0.5f * glm::abs(scale), glm::vec3(0.005f)),
            .center = (bounds.max + bounds.min) * 0.5f * scale,
            .mass = f.node.extras.mass > 0 ? f.node.extras.mass : 10};
}

void addMovable(const Furnished& f, const Body& body) {
    f.world.add(f.entity, body);
    f.world.write<MeshInstance>(f.entity)->movable = 1;
}

void addFlower(const Furnished& f) {
    f.world.add(f.entity, Flower{.wants = f.node.extras.wants,
                                 .amount = f.node.extras.amount,
                                 .room = f.node.extras.room,
                                 .shy = f.node.extras.shy});
    f.world.add(f.entity, render::IrradianceProbe{.offset = {0, kFlowerHead, 0}});
    f.world.add(f.entity, render::ProbeLight{});
}

void addPetal(const Furnished& f, const std::vector<Entity>& entities) {
    if (f.node.parent < 0) return;
    f.world.add(f.entity, Petal{entities[size_t(f.node.parent)], f.node.local.rotation});
    f.world.write<MeshInstance>(f.entity)->movable = 1;
}

void addHeart(const Furnished& f, const std::vector<Entity>& entities) {
    if (f.node.parent < 0) return;
    f.world.add(f.entity, FlowerHeart{entities[size_t(f.node.parent)]});
    f.world.write<MeshInstance>(f.entity)->movable = 1;
}

// The farther from the door, the later: the light walks through the room.
void addLantern(const Furnished& f, uint32_t number) {
    const glm::vec3 intensity =
        f.node.light >= 0 ? f.asset.lights[size_t(f.node.light)].intensity : glm::vec3(0);
    f.world.add(f.entity, Lantern{f.node.extras.room, 0.12f * float(number % 16), intensity});
    if (f.node.light >= 0) f.world.write<PunctualLight>(f.entity)->intensity = glm::vec3(0);
    if (f.node.mesh < 0) return;
    f.world.write<MeshInstance>(f.entity)->movable = 1;
    f.world.write<LocalTransform>(f.entity)->scale = glm::vec3(0.02f);
}

void addTurning(const Furnished& f) {
    const NodeExtras& e = f.node.extras;
    Body body = bodyOf(f, BodyKind::kDynamic);
    const bool pendulum = e.swing > 0;
    body.angularDamping = pendulum ? 0 : 0.95f;
    body.linearDamping = pendulum ? 0 : 0.2f;
    f.world.add(f.entity, Hinge{e.pivot, e.axis, pendulum ? 1 : e.least, pendulum ? -1 : e.most});
    if (pendulum) {
        f.world.add(f.entity, Pendulum{e.swing});
        f.world.write<LocalTransform>(f.entity)->rotation *= glm::angleAxis(e.swing, e.axis);
    }
    addMovable(f, body);
}

void addTagged(const Furnished& f, const std::vector<Entity>& entities, uint32_t& lanterns,
               uint32_t& flames) {
    const NodeExtras& e = f.node.extras;
    const bool shown = f.node.mesh >= 0;
    if (e.tag == "room")
        f.world.add(f.entity, Room{.center = f.node.local.translation,
                                   .half = e.moveExtent,
                                   .index = e.room,
                                   .openToSky = e.openToSky});
    if (e.tag == "lantern") addLantern(f, lanterns++);
    if (!shown) return;
    if (e.tag == "flame") addLantern(f, flames++);
    if (e.tag == "flower") addFlower(f);
    if (e.tag == "petal") addPetal(f, entities);
    if (e.tag == "heart") addHeart(f, entities);
    if (e.tag == "panel" || e.tag == "pendulum") addTurning(f);
    if (e.tag == "crate") {
        Body body = bodyOf(f, BodyKind::kDynamic);
        body.friction = 0.9f;
        f.world.add(f.entity, Crate{});
        addMovable(f, body);
    }
    if (e.tag == "door") {
        const Body body = bodyOf(f, BodyKind::kKinematic);
        f.world.add(f.entity, Door{f.node.local.translation, 2 * body.halfSize.y, e.room});
        addMovable(f, body);
    }
}

}  // namespace

std::vector<Hint> furnishWorld(World& world, const SceneAsset& asset, const std::vector<Entity>& entities) {
    std::vector<Hint> hints;
    uint32_t lanterns = 0, flames = 0;
    for (size_t i = 0; i < asset.nodes.size(); ++i) {
        const Furnished f{world, asset, asset.nodes[i], entities[i]};
        const NodeExtras& e = f.node.extras;
        if (f.node.name == "hand_lamp") world.add(f.entity, HandLamp{});
        if (e.flickerPeriod > 0 && f.node.light >= 0)
            world.add(f.entity, Flicker{asset.lights[size_t(f.node.light)].intensity, e.flickerDepth,
                                        e.flickerPeriod, e.flickerOff, uint32_t(i)});
        if (e.tag == "hint" || (e.tag == "room" && !e.text.empty()))
            hints.push_back({f.node.local.translation, e.room, e.text, e.tag == "room"});
        if (!e.tag.empty())
            addTagged(f, entities, lanterns, flames);
        else if (e.collider && f.node.mesh >= 0 && world.has<Mover>(f.entity))
            world.add(f.entity, bodyOf(f, BodyKind::kKinematic));
        else if (e.collider && f.node.mesh >= 0 && f.node.parent < 0)
            world.add(f.entity, bodyOf(f, BodyKind::kStatic));
    }
    return hints;
}

}  // namespace ag::game
