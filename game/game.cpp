#include "game/game.h"

#include <cmath>

#include "engine/scene/extract_system.h"
#include "engine/scene/spawn_scene.h"
#include "engine/scene/static_scene.h"

namespace ag::game {
namespace {

// Half the ground a node's mesh covers, before turning.
glm::vec2 halfGround(const SceneAsset& asset, const SceneNode& node) {
    Bounds bounds;
    const SceneMesh& mesh = asset.meshes[size_t(node.mesh)];
    for (uint32_t p = 0; p < mesh.primitiveCount; ++p)
        bounds.add(asset.geometry.primitives[mesh.firstPrimitive + p].boundsLocal);
    const glm::vec3 half = (bounds.max - bounds.min) * 0.5f * glm::abs(node.local.scale);
    return {half.x, half.z};
}

void addGameplay(World& world, const SceneAsset& asset, const std::vector<Entity>& entities) {
    for (size_t i = 0; i < asset.nodes.size(); ++i) {
        const SceneNode& node = asset.nodes[i];
        const NodeExtras& extras = node.extras;
        if (node.name == "hand_lamp") world.add(entities[i], HandLamp{});
        if (extras.collider && node.mesh >= 0) world.add(entities[i], Collider{halfGround(asset, node)});
        if (extras.flickerPeriod > 0 && node.light >= 0)
            world.add(entities[i], Flicker{asset.lights[size_t(node.light)].intensity, extras.flickerDepth,
                                           extras.flickerPeriod, extras.flickerOff, uint32_t(i)});
    }
}

}  // namespace

Game::Game(SceneAsset level, uint32_t threads)
    : level_(std::move(level)), schedule_(makeSchedule()), runner_(threads) {
    addGameplay(world_, level_, spawnScene(world_, level_));
    const CameraPose start = cameraOf(level_, 0);
    Player player{.position = start.position, .verticalFov = start.verticalFov};
    player.yaw = std::atan2(start.forward.x, -start.forward.z);
    player.pitch = std::asin(std::clamp(start.forward.y, -1.0f, 1.0f));
    world_.setResource<Player>(player);
    const Bounds bounds = staticScene(level_).bounds;
    world_.setResource<Walkable>(glm::dvec2(bounds.min.x, bounds.min.z),
                                 glm::dvec2(bounds.max.x, bounds.max.z));
    world_.setResource<GameTime>();
    world_.setResource<Input>();
    world_.setResource<ActiveCamera>(start);
    world_.setResource<ExtractState>();
    world_.setResource<RenderScene>().geometry = &level_.geometry;
}

void Game::tick(const Input& input, glm::uvec2 viewSize) {
    world_.resource<Input>() = input;
    world_.resource<ActiveCamera>().size = viewSize;
    schedule_.run(world_, runner_);
    GameTime& time = world_.resource<GameTime>();
    ++time.tick;
    time.seconds = double(time.tick) * time.step;
}

}  // namespace ag::game
