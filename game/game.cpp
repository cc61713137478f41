#include "game/game.h"

#include <algorithm>
#include <cmath>

#include "engine/physics/physics_system.h"
#include "engine/scene/extract_system.h"
#include "engine/scene/spawn_scene.h"
#include "engine/scene/static_scene.h"
#include "game/furnish_world.h"
#include "game/systems/make_sounds.h"
#include "game/systems/show_sky.h"

namespace ag::game {
namespace {

// Standing where the camera's eyes are.
Player playerAt(const CameraPose& start, PhysicsWorld& physics) {
    Player player{.position = start.position, .before = start.position, .verticalFov = start.verticalFov};
    player.yaw = std::atan2(start.forward.x, -start.forward.z);
    player.pitch = std::asin(std::clamp(start.forward.y, -1.0f, 1.0f));
    player.body.feet = start.position - glm::dvec3(0, double(player.eyeHeight), 0);
    const CharacterSettings settings;
    player.body.walker = physics.addWalker({settings.radius, settings.height}, player.body.feet);
    return player;
}

// A level without solid ground of its own gets one under everything.
void addGround(World& world, const SceneAsset& level) {
    bool solid = false;
    for (const SceneNode& node : level.nodes)
        solid = solid || (node.extras.collider && node.name == "ground");
    if (solid) return;
    const RenderScene scene = staticScene(level, likelyView(level));
    const Bounds& bounds = scene.bounds;  // relative to the origin
    if (bounds.empty()) return;
    const glm::vec3 middle = (bounds.min + bounds.max) * 0.5f, half = (bounds.max - bounds.min) * 0.5f;
    const auto wall = [&](glm::vec3 center, glm::vec3 size) {
        world.create(LocalTransform{.translation = glm::dvec3(center) + scene.originWorld}, WorldTransform{},
                     Body{.kind = BodyKind::kStatic, .halfSize = size});
    };
    wall({middle.x, bounds.min.y - 0.5f, middle.z}, {half.x + 1, 0.5f, half.z + 1});
    for (const float side : {-1.0f, 1.0f}) {
        wall({middle.x + side * (half.x + 0.5f), middle.y, middle.z}, {0.5f, half.y + 2, half.z + 1});
        wall({middle.x, middle.y, middle.z + side * (half.z + 0.5f)}, {half.x + 1, half.y + 2, 0.5f});
    }
}

}  // namespace

Game::Game(SceneAsset level, uint32_t threads)
    : level_(std::move(level)), tick_(makeTickSchedule()), frame_(makeFrameSchedule()), runner_(threads) {
    const CameraPose start = cameraOf(level_, 0);
    setUpPhysics(world_, start.position);
    hints_ = furnishWorld(world_, level_, spawnScene(world_, level_));
    addGround(world_, level_);
    world_.setResource<Player>(playerAt(start, *world_.resource<Physics>().world));
    world_.setResource<Progress>();
    world_.setResource<GameTime>();
    world_.setResource<PlayTime>().rooms.reserve(32);
    world_.setResource<Input>();
    world_.setResource<gi::ProbeReadings>();
    world_.setResource<Sounds>().now.reserve(32);
    world_.setResource<ActiveCamera>(start);
    world_.setResource<FreeEyes>();
    world_.setResource<ExtractState>();
    world_.setResource<RenderScene>().geometry = &level_.geometry;
    world_.setResource<LevelSky>().sky = level_.sky;
}

void Game::tick(const Input& input) {
    world_.resource<Input>() = input;
    tick_.run(world_, runner_);
    GameTime& time = world_.resource<GameTime>();
    ++time.tick;
    time.seconds = double(time.tick) * time.step;
}

void Game::frame(glm::uvec2 viewSize, float share) {
    world_.resource<ActiveCamera>().size = viewSize;
    world_.resource<Physics>().share = share;
    frame_.run(world_, runner_);
}

std::span<const Sound> Game::sounds() const {
    return world_.resource<Sounds>().now;
}

void Game::takeReadings(const gi::ProbeReadings& readings) {
    world_.resource<gi::ProbeReadings>() = readings;
}

}  // namespace ag::game
