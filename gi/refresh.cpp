#include "gi/refresh.h"

#include <algorithm>
#include <cmath>
#include <ranges>

namespace ag::gi {
namespace {

constexpr uint32_t kMostMoved = 64;      // instances: more are not small, and not looked at one by one
constexpr float kMostLeftBehind = 0.5f;  // of a thing's radius, between it and the light that it reflects

struct Ball {
    glm::vec3 centre;
    float radius;  // m
};

Ball ballRound(const Bounds& b) {
    return {0.5f * (b.min + b.max), 0.5f * glm::length(b.max - b.min)};
}

// Of a cone's directions: also of its light, if that is even. Nothing if the ball is outside.
float shareOfCone(const Ball& ball, glm::vec3 apex, glm::vec3 axis, float halfAngle) {
    const glm::vec3 to = ball.centre - apex;
    const float distance = std::max(glm::length(to), 1e-6f);
    if (distance <= ball.radius) return 1;
    const float ofBall = std::asin(ball.radius / distance);
    const float aside = std::acos(std::clamp(glm::dot(to, axis) / distance, -1.0f, 1.0f));
    if (aside - ofBall > halfAngle) return 0;
    return std::min((1 - std::cos(ofBall)) / (1 - std::cos(halfAngle)), 1.0f);
}

// Of the directions of a cone round the picture, which is a part of it.
float shareOfCamera(const Ball& ball, const RenderCamera& camera, glm::uvec2 size) {
    const float half = std::tan(0.5f * camera.verticalFov);
    const float aspect = float(size.x) / float(std::max(size.y, 1u));
    const float round = half * std::sqrt(1 + aspect * aspect);
    const float part = 4 * aspect / (glm::pi<float>() * (1 + aspect * aspect));
    return shareOfCone(ball, camera.position, camera.forward, std::atan(round)) / part;
}

float shareOfLight(const Ball& ball, const RenderLight& light, const Bounds& scene) {
    if (light.kind == LightKind::kDirectional) {
        const float share = ball.radius / std::max(0.5f * glm::length(scene.max - scene.min), 1e-6f);
        return std::min(share * share, 1.0f);
    }
    const float halfAngle = light.kind == LightKind::kSpot ? light.outerConeAngle : glm::pi<float>();
    return shareOfCone(ball, light.position, light.direction, halfAngle);
}

bool takeIfOther(auto& known, const auto& now) {
    const bool other = !(known == now);
    if (other) known = now;
    return other;
}

bool takeIfOtherLights(std::vector<RenderLight>& known, std::span<const RenderLight> lights) {
    auto bouncing = lights | std::views::filter(&RenderLight::bounces);
    const bool other = !std::ranges::equal(known, bouncing);
    if (other) known.assign(bouncing.begin(), bouncing.end());
    return other;
}

// Of what indirect light in the picture is like; how it is shown is another matter.
GiSettings settingsOfLight(GiSettings settings) {
    settings.composite = {};
    return settings;
}

// True if anything but where things stand is another than it was.
bool takeOthers(const SceneView& scene, const GiSettings& settings, RefreshHistory& h) {
    bool other = takeIfOther(h.settings, settingsOfLight(settings));
    other |= takeIfOtherLights(h.bounceLights, scene.scene->lights);
    other |= takeIfOther(h.size, scene.size);
    other |= takeIfOther(h.loadedVersion, scene.loadedVersion);
    other |= takeIfOther(h.cameraVersion, scene.scene->cameraVersion);
    other |= takeIfOther(h.originVersion, scene.scene->originVersion);
    return other;
}

// True if things came, went, or moved that are not small.
bool movesLargely(const SceneView& scene, float small, bool moved) {
    if (!moved) return false;
    uint32_t count = 0;
    for (const RenderScene::Range& range : scene.moved)
        count += range.end - range.begin;
    if (count == 0 || count > kMostMoved) return true;  // 0: all anew
    return shareSeen(scene) > small;
}

void forBalls(const SceneView& scene, auto&& visit) {
    for (const RenderScene::Range& range : scene.moved)
        for (uint32_t row = range.begin; row < range.end; ++row)
            visit(row, ballRound(scene.draws->boundsOf(row)));
}

bool isLit(const Ball& ball, const RenderScene& scene) {
    return std::ranges::any_of(scene.lights, [&](const RenderLight& light) {
        return light.bounces && shareOfLight(ball, light, scene.bounds) > 0;
    });
}

// True if the light that a thing reflects would stay visibly behind it. Notes where things are seen first.
bool leavesLightBehind(const SceneView& scene, std::vector<RefreshHistory::Place>& places) {
    bool behind = false;
    forBalls(scene, [&](uint32_t row, const Ball& ball) {
        const auto known = std::ranges::find(places, row, &RefreshHistory::Place::row);
        if (known == places.end()) {
            places.push_back({row, ball.centre});
        } else if (glm::distance(known->centre, ball.centre) > kMostLeftBehind * ball.radius) {
            behind = behind || isLit(ball, *scene.scene);
        }
    });
    return behind;
}

PixelShare choosePixels(const RefreshSettings& s, const RefreshHistory& h, bool all) {
    if (all) return {.some = true};
    return {.some = true, .index = h.sinceLights % s.pixelFrames, .count = s.pixelFrames};
}

}  // namespace

float shareSeen(const SceneView& scene) {
    const RenderScene& s = *scene.scene;
    float ofCamera = 0, most = 0;
    forBalls(scene,
             [&](uint32_t, const Ball& ball) { ofCamera += shareOfCamera(ball, s.camera, scene.size); });
    for (const RenderLight& light : s.lights) {
        float ofLight = 0;
        if (light.bounces)
            forBalls(scene,
                     [&](uint32_t, const Ball& ball) { ofLight += shareOfLight(ball, light, s.bounds); });
        most = std::max(most, ofLight);
    }
    return std::max(most, ofCamera);
}

Refresh chooseRefresh(const SceneView& scene, const GiSettings& settings, RefreshHistory& h) {
    const RefreshSettings& s = settings.refresh;
    const bool moved = takeIfOther(h.instancesVersion, scene.scene->instancesVersion);
    const bool other = takeOthers(scene, settings, h);
    const bool large = other || movesLargely(scene, s.small, moved);
    const auto count = [](bool now, uint32_t since) { return now ? 0 : std::min(since + 1, 1u << 20); };
    h.sinceLarge = count(large, h.sinceLarge);
    h.sinceMoved = count(moved, h.sinceMoved);
    // What settles does so undisturbed, and what waited comes before all is as it should be.
    const bool settled = h.sinceLarge > settings.valClustering.settleFrames;
    const bool waited = h.sincePatient == 0;
    const bool moves = moved || (waited && h.sinceMoved < s.lightFrames);
    const bool patient = s.lightFrames > 1 && settled && moves;
    h.sincePatient = count(patient, h.sincePatient);
    if (!patient) return {};
    const bool behind = leavesLightBehind(scene, h.places);
    const bool lights = !waited || behind || h.sinceLights + 1 >= s.lightFrames;
    h.sinceLights = lights ? 0 : h.sinceLights + 1;
    if (lights) {
        h.places.clear();
        leavesLightBehind(scene, h.places);
    }
    return {.lights = lights, .pixels = choosePixels(s, h, lights)};
}

}  // namespace ag::gi
