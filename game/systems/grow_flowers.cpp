#include "game/systems/grow_flowers.h"

#include <algorithm>

namespace ag::game {
namespace {

constexpr float kOpenSeconds = 1.8f, kBlindedSeconds = 2.5f, kWiltSeconds = 90;  // from end to end
constexpr float kLeastSeen = 0.1f;                                               // of the amount
constexpr float kPetalSpread = 1.15f;                                            // rad when open

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

}  // namespace

FlowerMood moodIn(const Flower& flower, const render::ProbeLight& light) {
    if (mean(light.direct) > kMostDirect) return FlowerMood::kBlinded;
    const float received = mean(light.bounced);
    if (received < kLeastSeen * flower.amount) return FlowerMood::kDark;
    if (matchOf(light.bounced, flower.wants) < kLeastMatch) return FlowerMood::kWrong;
    return received < flower.amount ? FlowerMood::kThirsty : FlowerMood::kGrowing;
}

void growFlowers(View<Flower, const render::ProbeLight> flowers, Res<const GameTime> time) {
    flowers.each([&](Flower& flower, const render::ProbeLight& light) {
        const Flower before = flower;
        flower.received = mean(light.bounced);
        flower.match = matchOf(light.bounced, flower.wants);
        if (flower.mood != FlowerMood::kOpen) {
            flower.mood = moodIn(flower, light);
            flower.openness = std::clamp(flower.openness + rate(flower.mood) * float(time->step), 0.0f, 1.0f);
        } else {
            flower.openness = std::min(flower.openness + float(time->step), 1.0f);
        }
        flower.bloomed = flower.openness >= kOpenEnough || (flower.bloomed && flower.openness >= kStillOpen);
        return flower.openness != before.openness || flower.mood != before.mood ||
               flower.received != before.received;
    });
}

void openPetals(View<const Petal, LocalTransform> petals, Lookup<const Flower> flowers) {
    petals.each([&](const Petal& petal, LocalTransform& local) {
        const Flower* flower = flowers(petal.flower);
        const float open = flower ? flower->openness : 0, eased = open * open * (3 - 2 * open);
        const glm::quat rotation = petal.closed * glm::angleAxis(kPetalSpread * eased, glm::vec3(1, 0, 0));
        if (local.rotation == rotation) return false;
        local.rotation = rotation;
        return true;
    });
}

}  // namespace ag::game
