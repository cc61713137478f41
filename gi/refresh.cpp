#include "gi/refresh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ag::gi {
namespace {

constexpr float kMostLeftBehind = 0.5f;  // of a thing's radius, between it and the light that it reflects

// Of a cone's directions: also of its light, if that is even. Nothing if the ball is outside.
float shareOfCone(const MovedThing& ball, glm::vec3 apex, glm::vec3 axis, float halfAngle) {
    const glm::vec3 to = ball.centre - apex;
    const float distance = std::max(glm::length(to), 1e-6f);
    if (distance <= ball.radius) return 1;
    const float ofBall = std::asin(ball.radius / distance);
    const float aside = std::acos(std::clamp(glm::dot(to, axis) / distance, -1.0f, 1.0f));
    if (aside - ofBall > halfAngle) return 0;
    return std::min((1 - std::cos(ofBall)) / (1 - std::cos(halfAngle)), 1.0f);
}

// Of the directions of a cone round the picture, which is a part of it.
float shareOfCamera(const MovedThing& ball, const RenderCamera& camera, glm::uvec2 size) {
    const float half = std::tan(0.5f * camera.verticalFov);
    const float aspect = float(size.x) / float(std::max(size.y, 1u));
    const float round = half * std::sqrt(1 + aspect * aspect);
    const float part = 4 * aspect / (std::numbers::pi_v<float> * (1 + aspect * aspect));
    return shareOfCone(ball, camera.position, camera.forward, std::atan(round)) / part;
}

float shareOfLight(const MovedThing& ball, const RsmLight& light, const Bounds& scene) {
    if (light.kind == LightKind::kDirectional) {
        const float share = ball.radius / std::max(0.5f * glm::length(scene.max - scene.min), 1e-6f);
        return std::min(share * share, 1.0f);
    }
    const float halfAngle = light.kind == LightKind::kSpot ? light.outerConeAngle : std::numbers::pi_v<float>;
    return shareOfCone(ball, light.position, light.direction, halfAngle);
}

bool takeIfOther(auto& known, const auto& now) {
    const bool other = !(known == now);
    if (other) known = now;
    return other;
}

bool takeIfOtherLights(std::vector<RsmLight>& known, std::span<const RsmLight> lights) {
    const bool other = !std::ranges::equal(known, lights);
    if (other) known.assign(lights.begin(), lights.end());
    return other;
}

// True if anything but where things stand is another than it was.
bool takeOthers(const World& world, glm::uvec2 size, const BounceLightSettings& settings, RefreshHistory& h) {
    bool other = takeIfOther(h.settings, settings);
    other |= takeIfOtherLights(h.lights, world.lights);
    other |= takeIfOtherLights(h.otherLights, world.otherLights);
    other |= takeIfOther(h.size, size);
    other |= takeIfOther(h.versions.scene, world.versions.scene);
    other |= takeIfOther(h.versions.camera, world.versions.camera);
    other |= takeIfOther(h.versions.origin, world.versions.origin);
    return other;
}

bool isLit(const MovedThing& thing, const World& world) {
    return std::ranges::any_of(
        world.lights, [&](const RsmLight& light) { return shareOfLight(thing, light, world.bounds) > 0; });
}

// True if the light that a thing reflects would stay visibly behind it. Notes where things are seen first.
bool leavesLightBehind(const World& world, std::vector<RefreshHistory::Place>& places) {
    bool behind = false;
    for (const MovedThing& thing : world.moved) {
        const auto known = std::ranges::find(places, thing.id, &RefreshHistory::Place::id);
        if (known == places.end())
            places.push_back({thing.id, thing.centre});
        else if (glm::distance(known->centre, thing.centre) > kMostLeftBehind * thing.radius)
            behind = behind || isLit(thing, world);
    }
    return behind;
}

PixelShare choosePixels(const RefreshSettings& s, const RefreshHistory& h, bool all) {
    if (all) return {.some = true};
    return {.some = true, .index = h.sinceLights % s.pixelFrames, .count = s.pixelFrames};
}

}  // namespace

float shareSeen(const World& world, const RenderCamera& camera, glm::uvec2 size) {
    float ofCamera = 0, most = 0;
    for (const MovedThing& thing : world.moved)
        ofCamera += shareOfCamera(thing, camera, size);
    for (const RsmLight& light : world.lights) {
        float ofLight = 0;
        for (const MovedThing& thing : world.moved)
            ofLight += shareOfLight(thing, light, world.bounds);
        most = std::max(most, ofLight);
    }
    return std::max(most, ofCamera);
}

Refresh chooseRefresh(const World& world, const RenderCamera& camera, glm::uvec2 size,
                      const BounceLightSettings& settings, RefreshHistory& h) {
    const RefreshSettings& s = settings.refresh;
    const bool moved = takeIfOther(h.versions.instances, world.versions.instances);
    const bool other = takeOthers(world, size, settings, h);
    // Things that came, went, or are not small; without any, all is anew.
    const bool largely = moved && (world.moved.empty() || shareSeen(world, camera, size) > s.small);
    const auto count = [](bool now, uint32_t since) { return now ? 0 : std::min(since + 1, 1u << 20); };
    h.sinceLarge = count(other || largely, h.sinceLarge);
    h.sinceMoved = count(moved, h.sinceMoved);
    // What settles does so undisturbed, and what waited comes before all is as it should be.
    const bool settled = h.sinceLarge > settings.valClustering.settleFrames;
    const bool waited = h.sincePatient == 0;
    const bool moves = moved || (waited && h.sinceMoved < s.lightFrames);
    const bool patient = s.lightFrames > 1 && settled && moves;
    h.sincePatient = count(patient, h.sincePatient);
    if (!patient) return {};
    const bool behind = leavesLightBehind(world, h.places);
    const bool lights = !waited || behind || h.sinceLights + 1 >= s.lightFrames;
    h.sinceLights = lights ? 0 : h.sinceLights + 1;
    if (lights) {
        h.places.clear();
        leavesLightBehind(world, h.places);
    }
    return {.lights = lights, .pixels = choosePixels(s, h, lights)};
}

}  // namespace ag::gi
