#include "game/hud.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/physics/physics_system.h"
#include "engine/renderer/probe_components.h"
#include "engine/scene/components.h"
#include "game/systems/carry_crates.h"
#include "game/systems/walk_player.h"

namespace ag::game {
namespace {

constexpr float kGrazing = 1;  // W/m², up to which direct light is a beam's soft edge

struct Hue {
    glm::vec3 color;
    Shape shape;
};
constexpr std::array<Hue, 7> kHues = {{{{1, 1, 1}, Shape::kCircle},
                                       {{1, 0.05f, 0.05f}, Shape::kTriangle},
                                       {{0.2f, 1, 0.2f}, Shape::kSquare},
                                       {{0.15f, 0.3f, 1}, Shape::kDiamond},
                                       {{1, 0.75f, 0.05f}, Shape::kStar},
                                       {{1, 0.1f, 0.65f}, Shape::kCross},
                                       {{0.1f, 1, 0.95f}, Shape::kHexagon}}};

std::string goalText(const Progress& p, const Room* room) {
    if (p.won) return "The gallery is lit. Thank you for the light.";
    if (!room) return fmt::format("Rooms {} of {}", p.roomsSolved, p.rooms);
    if (room->flowers == 0) return fmt::format("Rooms {} of {}", p.roomsSolved, p.rooms);
    if (room->solved) return "The door is open";
    return fmt::format("Flowers open: {} of {}", room->open, room->flowers);
}

std::string nearestHint(const std::vector<Hint>& hints, const Player& player, int32_t room) {
    const Hint* best = nullptr;
    double nearest = 1e9;
    for (const Hint& hint : hints) {
        glm::dvec3 d = hint.position - player.position;
        d.y = 0;
        if (hint.room != room || hint.isRule || glm::length(d) >= nearest) continue;
        nearest = glm::length(d);
        best = &hint;
    }
    return best ? best->text : "";
}

// The open flower is done with; of the others the one nearest to the middle of the view is meant.
void chooseMeant(std::vector<FlowerLine>& flowers, const Player& player) {
    const glm::dvec3 ahead(viewDirection(player.yaw, player.pitch));
    FlowerLine* best = nullptr;
    double nearest = -2;
    for (FlowerLine& flower : flowers) {
        const double cosine = glm::dot(glm::normalize(flower.position - player.position), ahead);
        if (flower.mood == FlowerMood::kOpen || cosine <= nearest) continue;
        nearest = cosine;
        best = &flower;
    }
    if (best) best->meant = true;
}

std::string ruleOf(const std::vector<Hint>& rules, int32_t room) {
    for (const Hint& rule : rules)
        if (rule.room == room && rule.isRule) return rule.text;
    return "";
}

float strongest(glm::vec3 light) {
    return std::max({light.x, light.y, light.z});
}

bool crateInReach(World& world, const Player& player) {
    const PhysicsWorld& physics = *world.resource<Physics>().world;
    bool any = false;
    View<const Crate, const BodyState>(world, {}).each(
        [&](const Crate&, const BodyState& state) { any = any || graspOf(physics, player, state.body) > 0; });
    return any;
}

}  // namespace

Shape shapeOf(glm::vec3 wants) {
    const auto match = [&](const Hue& hue) {
        return glm::dot(glm::normalize(hue.color), glm::normalize(wants));
    };
    return std::ranges::max_element(kHues, {}, match)->shape;
}

const char* shapeName(Shape shape) {
    static constexpr const char* kNames[] = {"circle, white", "triangle, red", "square, green",
                                             "diamond, blue", "star, yellow",  "cross, magenta",
                                             "hexagon, cyan"};
    return kNames[size_t(shape)];
}

const char* moodText(const FlowerLine& flower) {
    if (flower.mood == FlowerMood::kBlinded && flower.grazed) return "a beam's edge!";
    static constexpr const char* kTexts[] = {"in the dark",   "not its colour", "still too dim", "opening",
                                             "direct light!", "open",           "too bright"};
    return kTexts[size_t(flower.mood)];
}

HudState readHud(World& world, const std::vector<Hint>& hints, bool showHints) {
    const Progress& progress = world.resource<Progress>();
    const Player& player = world.resource<Player>();
    HudState hud;
    const Room* here = nullptr;
    View<const Room>(world, {}).each([&](const Room& room) {
        if (room.index == progress.room) here = &room;
    });
    View<const Flower, const render::ProbeLight, const LocalTransform>(world, {}).each(
        [&](const Flower& f, const render::ProbeLight& light, const LocalTransform& at) {
            if (f.room != progress.room) return;
            // Full bars are the amount, of light that is exactly the wanted colour.
            const glm::vec3 full = f.wants * (3 * f.amount / (f.wants.x + f.wants.y + f.wants.z));
            const float top = std::max({full.x, full.y, full.z, 1e-6f});
            hud.flowers.push_back(
                {.wants = full / top,
                 .received = light.bounced / top,
                 .openness = f.openness,
                 .promise = f.promise,
                 .mood = f.mood,
                 .closing = f.openness > 0 && f.mood != FlowerMood::kGrowing && f.mood != FlowerMood::kOpen,
                 .grazed = strongest(light.direct) < kGrazing,
                 .shy = f.shy != 0,
                 .position = at.translation + glm::dvec3(0, 0.8, 0)});
        });
    hud.goal = goalText(progress, here);
    chooseMeant(hud.flowers, player);
    if (here && !here->solved) hud.rule = ruleOf(hints, progress.room);
    hud.legend = progress.roomsSolved == 0;
    hud.carrying = bool(player.carried);
    hud.crateInReach = !hud.carrying && crateInReach(world, player);
    if (showHints && !progress.won && progress.idle >= kHintSeconds && !(here && here->solved))
        hud.hint = nearestHint(hints, player, progress.room);
    return hud;
}

}  // namespace ag::game
