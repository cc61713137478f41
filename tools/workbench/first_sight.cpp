#include "tools/workbench/first_sight.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <span>

#include "tools/workbench/free_space.h"

namespace ag::workbench {
namespace {

constexpr uint32_t kTries = 2048, kMostPlaces = 64, kHeadings = 16;
constexpr float kLeastFree = 0.02f;   // part of the box's places: fewer are hollows of a thing
constexpr float kEyeHeight = 0.35f;   // of a room's height
constexpr float kLeastHeight = 1.5f;  // m, of a room: less is a thing's hollow
constexpr glm::uvec2 kRays(12, 7);    // of a picture
constexpr float kTurn = 2 * std::numbers::pi_v<float>;

// A ray for every part of a picture 16:9.
template <class F>
void forEachRay(const CameraPose& pose, F&& use) {
    const glm::vec3 right = rightOf(pose.forward, pose.up), top = glm::cross(right, pose.forward);
    const float height = std::tan(0.5f * pose.verticalFov), width = height * 16 / 9;
    for (uint32_t y = 0; y < kRays.y; ++y)
        for (uint32_t x = 0; x < kRays.x; ++x) {
            const glm::vec2 at = (glm::vec2(x, y) + 0.5f) / glm::vec2(kRays) * 2.0f - 1.0f;
            use(glm::normalize(pose.forward + right * (at.x * width) + top * (at.y * height)));
        }
}

// Long sights with many things in them; little of the sky, no wall before the eyes.
float worthOf(const reference::RayScene& rays, const CameraPose& pose, glm::vec3 origin, float clearance) {
    constexpr float kSky = 1, kTooNear = -4, kPerThing = 0.25f;
    float sum = 0;
    std::set<uint32_t> things;
    forEachRay(pose, [&](glm::vec3 direction) {
        reference::Surface s;
        if (!rays.intersect(origin, direction, s))
            sum += kSky;
        else if (s.hidden || s.distance < 2 * clearance)
            sum += kTooNear;
        else {
            sum += std::log2(s.distance / clearance);
            things.insert(s.part);
        }
    });
    return sum / float(kRays.x * kRays.y) + kPerThing * std::log2(1 + float(things.size()));
}

// At the height of eyes above the floor below; nothing where there is no room for it.
bool standAt(const reference::RayScene& rays, glm::vec3& place, float clearance) {
    if (!isFree(rays, place, clearance)) return false;
    reference::Surface floor, ceiling;
    rays.intersect(place, {0, -1, 0}, floor);
    const bool roofed = rays.intersect(place, {0, 1, 0}, ceiling);
    const float height = roofed ? floor.distance + ceiling.distance : floor.distance;
    place.y += kEyeHeight * height - floor.distance;
    return height > kLeastHeight && isFree(rays, place, clearance);
}

CameraPose lookingAlong(const RenderScene& scene, glm::vec3 from, float heading, float clearance) {
    CameraPose pose;
    pose.position = scene.originWorld + glm::dvec3(from);
    pose.forward = glm::normalize(glm::vec3(std::cos(heading), -0.06f, std::sin(heading)));
    pose.verticalFov = 1;
    pose.near = std::min(0.05f, 0.1f * clearance);
    return pose;
}

CameraPose fromOutside(const RenderScene& scene) {
    CameraPose pose = framingCamera(scene.bounds);
    pose.position += scene.originWorld;
    return pose;
}

glm::vec3 sunDirection(uint32_t heading, float elevation) {
    const float angle = kTurn * float(heading) / kHeadings;
    return {std::cos(elevation) * std::cos(angle), -std::sin(elevation),
            std::cos(elevation) * std::sin(angle)};
}

std::vector<reference::Surface> seenFrom(const reference::RayScene& rays, const CameraPose& pose) {
    std::vector<reference::Surface> seen;
    const glm::vec3 eye(pose.position - rays.scene().originWorld);
    forEachRay(pose, [&](glm::vec3 direction) {
        reference::Surface s;
        glm::vec3 from = eye + direction * pose.near;
        while (rays.intersect(from, direction, s) && s.hidden)
            from = s.position + direction * rays.offset();
        if (s.distance > 0 && !s.hidden) seen.push_back(s);
    });
    return seen;
}

float litBy(const reference::RayScene& rays, const std::vector<reference::Surface>& seen, glm::vec3 sun) {
    uint32_t lit = 0;
    for (const reference::Surface& s : seen)
        lit += glm::dot(s.geometricNormal, -sun) > 0.05f &&
               rays.visible(s.position + s.geometricNormal * rays.offset(), -sun, INFINITY);
    return seen.empty() ? 0.0f : float(lit) / float(seen.size());
}

struct RatedPose {
    CameraPose pose;
    float worth = 0;
};

// The best heading at each place, best places first; that from outside where there are too few.
std::vector<RatedPose> ratePoses(const reference::RayScene& rays) {
    const RenderScene& scene = rays.scene();
    const float clearance = 0.01f * glm::length(scene.bounds.max - scene.bounds.min);
    std::vector<RatedPose> poses;
    uint32_t tries = 0;
    for (; tries < kTries && poses.size() < kMostPlaces; ++tries) {
        glm::vec3 place = placeInBounds(scene.bounds, tries);
        if (!standAt(rays, place, clearance)) continue;
        RatedPose best{.worth = -INFINITY};
        for (uint32_t h = 0; h < kHeadings; ++h) {
            const CameraPose pose = lookingAlong(scene, place, kTurn * float(h) / kHeadings, clearance);
            const float worth = worthOf(rays, pose, place, clearance);
            if (worth > best.worth) best = {pose, worth};
        }
        poses.push_back(best);
    }
    if (float(poses.size()) < kLeastFree * float(tries)) return {{fromOutside(scene)}};
    std::ranges::stable_sort(poses, std::greater(), &RatedPose::worth);
    return poses;
}

FirstSight withBestSun(const reference::RayScene& rays, const CameraPose& pose) {
    FirstSight sight{.pose = pose,
                     .sun = {.kind = LightKind::kDirectional,
                             .direction = glm::normalize(glm::vec3(0.25f, -1, 0.35f)),
                             .intensity = glm::vec3(10),
                             .bounces = true,
                             .id = 1}};
    const std::vector<reference::Surface> seen = seenFrom(rays, pose);
    sight.litShare = litBy(rays, seen, sight.sun.direction);
    for (const float elevation : {1.05f, 0.79f, 0.52f, 1.31f})
        for (uint32_t heading = 0; heading < kHeadings; ++heading) {
            const glm::vec3 direction = sunDirection(heading, elevation);
            const float share = litBy(rays, seen, direction);
            if (share <= sight.litShare) continue;
            sight.litShare = share;
            sight.sun.direction = direction;
        }
    return sight;
}

}  // namespace

FirstSight chooseFirstSight(const RenderScene& scene, const std::optional<CameraPose>& given, bool needsSun) {
    constexpr size_t kMostTried = 12;  // of the poses, with suns
    constexpr float kEnoughLit = 0.25f, kPerLit = 4;
    if (scene.bounds.empty()) return {.pose = given.value_or(CameraPose{})};
    const reference::RayScene rays(scene);
    const std::vector<RatedPose> poses = given ? std::vector<RatedPose>{{*given}} : ratePoses(rays);
    if (!needsSun) return {.pose = poses[0].pose};
    FirstSight best;
    float worth = -INFINITY;
    for (const RatedPose& rated : std::span(poses).first(std::min(poses.size(), kMostTried))) {
        const FirstSight sight = withBestSun(rays, rated.pose);
        const float own = rated.worth + kPerLit * std::min(sight.litShare, kEnoughLit);
        if (own <= worth) continue;
        worth = own;
        best = sight;
    }
    return best;
}

}  // namespace ag::workbench
