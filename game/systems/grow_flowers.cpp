#include "game/systems/grow_flowers.h"

#include <algorithm>
#include <cmath>

namespace ag::game {
namespace {

constexpr float kOpenSeconds = 1.8f, kBlindedSeconds = 2.5f, kWiltSeconds = 90;  // from end to end
constexpr float kLeastSeen = 0.1f;                                               // of the amount
constexpr float kPetalSpread = 1.15f;                                            // rad when open
constexpr float kParted = 0.4f;        // of that by its light alone, before it opens
constexpr float kNoMatch = 0.5f;       // cosine at which a colour is as wrong as can be
constexpr float kLeastStep = 0.01f;    // of what is shown: less does not move anything
constexpr float kHeartAsleep = 0.05f;  // of a heart's size in the dark

float mean(glm::vec3 e) {
    return (e.x + e.y + e.z) / 3;
}

float matchOf(glm::vec3 light, glm::vec3 wants) {
    const float length = glm::length(light) * glm::length(wants);
    return length > 0 ? glm::dot(light, wants) / length : 0;
}

// Of openness, 1/s.
float rate(FlowerMood mood) {
    if (mood == FlowerMood::kGrowing) return 1 / kOpenSeconds;
    if (mood == FlowerMood::kBlinded) return -1 / kBlindedSeconds;
    return -1 / kWiltSeconds;
}

float smoothly(float from, float to, float x) {
    const float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

// Of its light by its amount alone.
float enough(const Flower& flower, float received) {
    if (flower.shy) return flower.amount / std::max(received, flower.amount);
    return std::min(received / std::max(flower.amount, 1e-6f), 1.0f);
}

// In steps, so that what hardly changes stays what it is.
float stepped(float value) {
    return std::round(value / kLeastStep) * kLeastStep;
}

}  // namespace

float softEdge(const PunctualLight& light, const LocalTransform& at, glm::dvec3 point) {
    if (light.kind != LightKind::kSpot) return 0;
    const glm::vec3 to(point - at.translation);
    const float distance = std::max(glm::length(to), 1e-3f);
    const float cosine = glm::dot(to / distance, at.rotation * glm::vec3(0, 0, -1));
    const float inner = std::cos(light.innerConeAngle), outer = std::cos(light.outerConeAngle);
    const float t = std::clamp((cosine - outer) / std::max(inner - outer, 1e-4f), 0.0f, 1.0f);
    const float strength = t * t;
    // A lamp's map has texels: a little more than the formula's is still the edge.
    const float margin = 1.25f * (1 - smoothly(kEdge, 2 * kEdge, strength));
    return margin * strength * mean(light.intensity) / (4 * distance * distance);
}

float promiseIn(const Flower& flower, const render::ProbeLight& light, float direct) {
    const float received = mean(light.bounced);
    const float match =
        flower.shy ? 1 : smoothly(kNoMatch, kLeastMatch, matchOf(light.bounced, flower.wants));
    return enough(flower, received) * match * kMostDirect / std::max(direct, kMostDirect);
}

FlowerMood moodIn(const Flower& flower, const render::ProbeLight& light, float direct) {
    if (direct > kMostDirect) return FlowerMood::kBlinded;
    const float received = mean(light.bounced);
    if (flower.shy) return received > flower.amount ? FlowerMood::kDazzled : FlowerMood::kGrowing;
    if (received < kLeastSeen * flower.amount) return FlowerMood::kDark;
    if (matchOf(light.bounced, flower.wants) < kLeastMatch) return FlowerMood::kWrong;
    return received < flower.amount ? FlowerMood::kThirsty : FlowerMood::kGrowing;
}

void growFlowers(View<Flower, const render::ProbeLight, const LocalTransform> flowers,
                 View<const PunctualLight, const BounceLight, const LocalTransform> lights,
                 Res<const Progress> progress, Res<const GameTime> time) {
    flowers.each([&](Flower& flower, const render::ProbeLight& light, const LocalTransform& at) {
        const Flower before = flower;
        if (light.measured == 0) return false;  // nothing was measured yet
        float edges = 0;
        const glm::dvec3 head = at.translation + glm::dvec3(0, double(kFlowerHead), 0);
        lights.each([&](const PunctualLight& lamp, const BounceLight&, const LocalTransform& place) {
            edges += softEdge(lamp, place, head);
        });
        const float direct = std::max(mean(light.direct) - edges, 0.0f);
        flower.promise = flower.mood == FlowerMood::kOpen ? 1 : promiseIn(flower, light, direct);
        flower.received = mean(light.bounced);
        flower.match = matchOf(light.bounced, flower.wants);
        if (flower.mood != FlowerMood::kOpen && flower.room != progress->room) {
            flower.mood = FlowerMood::kDark;  // nothing opens or closes where nobody is
        } else if (flower.mood != FlowerMood::kOpen) {
            flower.mood = moodIn(flower, light, direct);
            flower.openness = std::clamp(flower.openness + rate(flower.mood) * float(time->step), 0.0f, 1.0f);
        } else {
            flower.openness = std::min(flower.openness + float(time->step), 1.0f);
        }
        flower.bloomed = flower.openness >= kOpenEnough || (flower.bloomed && flower.openness >= kStillOpen);
        return flower.openness != before.openness || flower.mood != before.mood ||
               flower.received != before.received || flower.promise != before.promise;
    });
}

void openPetals(View<const Petal, LocalTransform> petals, Lookup<const Flower> flowers) {
    petals.each([&](const Petal& petal, LocalTransform& local) {
        const Flower* flower = flowers(petal.flower);
        const float opened = flower ? std::max(flower->openness, kParted * stepped(flower->promise)) : 0,
                    eased = opened * opened * (3 - 2 * opened);
        const glm::quat rotation = petal.closed * glm::angleAxis(kPetalSpread * eased, glm::vec3(1, 0, 0));
        if (local.rotation == rotation) return false;
        local.rotation = rotation;
        return true;
    });
}

void growHearts(View<const FlowerHeart, LocalTransform> hearts, Lookup<const Flower> flowers) {
    hearts.each([&](const FlowerHeart& heart, LocalTransform& local) {
        const Flower* flower = flowers(heart.flower);
        const glm::vec3 scale(kHeartAsleep + (1 - kHeartAsleep) * (flower ? stepped(flower->promise) : 0));
        if (local.scale == scale) return false;
        local.scale = scale;
        return true;
    });
}

}  // namespace ag::game
