#include "game/photo_mode.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/core/safe_file.h"
#include "engine/renderer/probe_components.h"
#include "engine/scene/extract_system.h"
#include "game/hud.h"
#include "game/systems/show_sky.h"

namespace ag::game {
namespace {

constexpr float kFlySpeed = 2.5f;                        // m/s
constexpr float kHourStep = 0.25f, kViewStep = 5;        // h, degrees a key press
constexpr float kFirstHour = 6.25f, kLastHour = 17.75f;  // the sun is up
constexpr float kLeastView = 10, kMostView = 110;        // degrees, upright

// The sun rises at six, stands highest at twelve and sets at eighteen.
float hourOf(const LevelDaylight& daylight) {
    const float height = std::asin(std::clamp(-daylight.sunDirection.y, 0.0f, 1.0f));
    return 18 - 12 * height / std::numbers::pi_v<float>;
}

// It goes through the zenith, in the plane in which the level's sun stands.
glm::vec3 sunDirectionAt(const LevelDaylight& daylight, float hour) {
    const glm::vec3 level(daylight.sunDirection.x, 0, daylight.sunDirection.z);
    const float length = glm::length(level), angle = (18 - hour) / 12 * std::numbers::pi_v<float>;
    const glm::vec3 evening = length > 0 ? level / length : glm::vec3(1, 0, 0);
    return evening * std::cos(angle) - glm::vec3(0, std::sin(angle), 0);
}

std::string lightLine(const Flower& flower, const gi::ProbeReading& light) {
    const float direct = (light.direct.x + light.direct.y + light.direct.z) / 3;
    return fmt::format("{}: {:.4f} {:.4f} {:.4f} W/m² bounced, {:.4f} direct; {} {:.4f}",
                       flower.shy ? "darkness" : shapeName(shapeOf(flower.wants)), light.bounced.x,
                       light.bounced.y, light.bounced.z, direct, flower.shy ? "bears" : "wants",
                       flower.amount);
}

}  // namespace

void PhotoMode::enter(Game& game) {
    if (on_) return;
    on_ = true;
    World& world = game.world();
    camera_ = freeCameraAt(world.resource<ActiveCamera>().pose, {});
    camera_.speed = kFlySpeed;
    daylight_ = daylightOf(game.level());
    hour_ = daylight_.amount > 0 ? hourOf(daylight_) : 0;
    LevelSky& sky = world.resource<LevelSky>();
    skyBefore_ = sky.sky;
    seenBefore_ = game.scene().sky;
    changedSky_ = seenBefore_ != skyBefore_;
    rested_ = 0;
    sky.everywhere = true;  // the camera may go where the player is not
    lookAt(game);
}

void PhotoMode::leave(Game& game) {
    if (!on_) return;
    on_ = false;
    World& world = game.world();
    world.resource<FreeEyes>().open = false;
    world.resource<LevelSky>() = {.sky = std::exchange(skyBefore_, nullptr)};
    world.resource<RenderScene>().sky = std::exchange(seenBefore_, nullptr);
}

void PhotoMode::lookAt(Game& game) {
    game.world().resource<FreeEyes>() = {true, poseOf(camera_)};
}

void PhotoMode::move(Game& game, const Input& input, float seconds) {
    const CameraPose before = poseOf(camera_);
    moveFreely(camera_, input, seconds);
    const CameraPose now = poseOf(camera_);
    const bool still = now.position == before.position && now.forward == before.forward;
    rested_ = still ? rested_ + seconds : 0;
    lookAt(game);
}

void PhotoMode::setHour(Game& game, float hour) {
    if (daylight_.amount <= 0) return;
    hour_ = std::clamp(hour, kFirstHour, kLastHour);
    rested_ = 0;
    changedSky_ = true;
    const LevelDaylight then{sunDirectionAt(daylight_, hour_), daylight_.amount};
    game.world().resource<LevelSky>().sky = std::make_shared<const Sky>(skyOf(then));
}

void PhotoMode::press(Game& game, int code) {
    const auto widen = [&](float degrees) {
        const float angle = glm::degrees(camera_.verticalFov) + degrees;
        camera_.verticalFov = glm::radians(std::clamp(angle, kLeastView, kMostView));
        rested_ = 0;
        lookAt(game);
    };
    if (code == GLFW_KEY_UP) widen(-kViewStep);
    if (code == GLFW_KEY_DOWN) widen(kViewStep);
    // To the next quarter of an hour.
    if (code == GLFW_KEY_LEFT) setHour(game, (std::ceil(hour_ / kHourStep) - 1) * kHourStep);
    if (code == GLFW_KEY_RIGHT) setHour(game, (std::floor(hour_ / kHourStep) + 1) * kHourStep);
    if (code == GLFW_KEY_H) showsLines_ = !showsLines_;
}

std::vector<std::string> PhotoMode::lines(Game& game, const gi::ProbeReadings& readings,
                                          const std::string& layer) const {
    std::string first = fmt::format("{:.0f} degrees", glm::degrees(camera_.verticalFov));
    if (daylight_.amount > 0) {
        const int minutes = int(std::lround(hour_ * 60));
        first += fmt::format("   {:02}:{:02}", minutes / 60, minutes % 60);
    }
    if (!layer.empty()) first += "   " + layer;
    std::vector<std::string> lines{first};
    View<const Flower, const LocalTransform>(game.world(), {})
        .each([&](Entity entity, const Flower& flower, const LocalTransform& at) {
            const auto light = readings.of(entity.bits());
            if (light && glm::distance(at.translation, camera_.position) < kNear)
                lines.push_back(lightLine(flower, *light));
        });
    return lines;
}

std::string nextPhoto(const std::string& folder) {
    std::string stem;
    for (int i = 1; stem.empty() || fileExists(stem + ".png") || fileExists(stem + ".exr"); ++i)
        stem = fmt::format("{}/photo-{:03}", folder, i);
    return stem;
}

}  // namespace ag::game
