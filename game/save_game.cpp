#include "game/save_game.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "engine/core/hash.h"
#include "engine/core/safe_file.h"
#include "engine/physics/physics_system.h"
#include "engine/scene/components.h"
#include "engine/scene/static_scene.h"
#include "game/save_format.h"

namespace ag::game {

uint64_t levelHash(const SceneAsset& level) {
    uint64_t hash = hashBytes(std::as_bytes(std::span(level.name)));
    for (const SceneNode& node : level.nodes)
        hash = combineHash(hash, hashBytes(std::as_bytes(std::span(node.name))));
    return hash;
}

namespace {

constexpr size_t kMostTimedRooms = 64;
constexpr double kNotKnown = -1e9;     // s
constexpr double kMarginOfLevel = 50;  // m about it where things may have come to lie

SaveLimits limitsOf(const Game& game) {
    const SceneAsset& level = game.level();
    SaveLimits limits{.level = levelHash(level), .nodes = uint32_t(level.nodes.size())};
    for (const SceneNode& node : level.nodes)
        limits.mostRoom = std::max(limits.mostRoom, node.extras.room);
    const RenderScene scene = staticScene(level, likelyView(level));
    if (scene.bounds.empty()) return limits;
    limits.least = glm::dvec3(scene.bounds.min) + scene.originWorld - kMarginOfLevel;
    limits.most = glm::dvec3(scene.bounds.max) + scene.originWorld + kMarginOfLevel;
    return limits;
}

void apply(World& world, const Saved& saved) {
    makeBodies(world);
    PhysicsWorld& physics = *world.resource<Physics>().world;
    Player& player = world.resource<Player>();
    player.body.feet = saved.feet;
    player.yaw = saved.yaw;
    player.pitch = saved.pitch;
    player.position = player.before = saved.feet + glm::dvec3(0, double(player.eyeHeight), 0);
    physics.moveWalker(player.body.walker, {CharacterSettings{}.radius, player.body.height}, saved.feet);
    world.resource<Progress>().won = saved.won;
    PlayTime& played = world.resource<PlayTime>();
    played.known = saved.played >= 0;
    // A save of before times were kept: what was spent in a room is not known.
    if (!saved.timed) played.rooms.assign(kMostTimedRooms, kNotKnown);
    played.whole = std::max(saved.played, 0.0);
    for (const SavedTime& t : saved.times) {
        if (size_t(t.room) >= played.rooms.size()) played.rooms.resize(size_t(t.room) + 1);
        played.rooms[size_t(t.room)] = t.seconds;
    }
    View<Room>(world, {world.version(), 0}).each([&](Room& room) {
        for (const SavedRoom& s : saved.rooms)
            if (s.index == room.index) room.solved = 1, room.since = s.since;
    });
    View<Flower, const LocalTransform>(world, {world.version(), 0})
        .each([&](Flower& flower, const LocalTransform& at) {
            for (const SavedFlower& s : saved.flowers)
                if (s.node == at.node) flower.openness = s.openness;
        });
    View<BodyState, LocalTransform, const Body>(world, {world.version(), 0})
        .each([&](BodyState& state, LocalTransform& at, const Body& body) {
            for (const SavedBody& s : saved.bodies) {
                if (s.node != at.node || body.kind != BodyKind::kDynamic) continue;
                physics.place(state.body, s.position, s.rotation);
                at.translation = state.position = state.previousPosition = s.position;
                at.rotation = state.rotation = state.previousRotation = glm::normalize(s.rotation);
            }
        });
}

}  // namespace

std::string saveText(Game& game) {
    World& world = game.world();
    const Player& p = game.player();
    std::string text = saveHead(levelHash(game.level()));
    text +=
        fmt::format("player {} {} {} {} {}\n", p.body.feet.x, p.body.feet.y, p.body.feet.z, p.yaw, p.pitch);
    const PlayTime& played = world.resource<PlayTime>();
    text += fmt::format("played {}\n", played.known ? played.whole : -1);
    if (game.progress().won) text += "won\n";
    for (size_t i = 0; i < played.rooms.size(); ++i)
        if (played.rooms[i] > 0) text += fmt::format("spent {} {}\n", i, played.rooms[i]);
    View<const Room>(world, {}).each([&](const Room& r) {
        if (r.solved) text += fmt::format("room {} {}\n", r.index, r.since);
    });
    View<const Flower, const LocalTransform>(world, {}).each([&](const Flower& f, const LocalTransform& at) {
        if (f.openness > 0) text += fmt::format("flower {} {}\n", at.node, f.openness);
    });
    View<const BodyState, const LocalTransform, const Body>(world, {}).each(
        [&](const BodyState& s, const LocalTransform& at, const Body& body) {
            if (body.kind != BodyKind::kDynamic) return;
            text += fmt::format("body {} {} {} {} {} {} {} {}\n", at.node, s.position.x, s.position.y,
                                s.position.z, s.rotation.w, s.rotation.x, s.rotation.y, s.rotation.z);
        });
    return text + "end\n";
}

Status saveGame(Game& game, const std::string& path) {
    return writeFileSafely(path, saveText(game));
}

Status checkSave(const Game& game, const std::string& text, const std::string& path) {
    const auto saved = parseSave(text, path, limitsOf(game));
    if (!saved) return saved.error();
    return Ok{};
}

Status putSaveAside(const std::string& path, const std::string& suffix) {
    std::error_code error;
    std::filesystem::rename(path, path + suffix, error);
    if (error) return Error{path + ": " + error.message()};
    return Ok{};
}

Status putBrokenSaveAside(const Game& game, const std::string& path) {
    const auto text = readFile(path);
    if (text && checkSave(game, *text, path)) return Ok{};
    return putSaveAside(path, ".broken");
}

Status restoreGame(Game& game, const std::string& text, const std::string& path) {
    const auto saved = parseSave(text, path, limitsOf(game));
    if (!saved) return saved.error();
    apply(game.world(), *saved);
    return Ok{};
}

bool startAtRoom(Game& game, int32_t room) {
    constexpr double kInside = 0.9;  // m from the door
    Saved saved{.timed = true};
    bool found = false;
    View<const Room>(game.world(), {}).each([&](const Room& r) {
        if (r.index < room) saved.rooms.push_back({r.index, 59});
        if (r.index != room) return;
        found = true;
        saved.feet = r.center + glm::dvec3(0, 0, double(r.half.z) - kInside);
    });
    if (found) apply(game.world(), saved);
    return found;
}

Status continueGame(Game& game, const std::string& path) {
    const auto text = readFile(path);
    if (!text) return text.error();
    return restoreGame(game, *text, path);
}

}  // namespace ag::game
