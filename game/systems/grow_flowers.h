// Flowers: they open in bounced light of their colour, and close in direct light.
#pragma once

#include "engine/ecs/view.h"
#include "engine/renderer/probe_components.h"
#include "engine/scene/components.h"
#include "game/components.h"

namespace ag::game {

constexpr float kLeastMatch = 0.92f;  // cosine between a flower's colour and the light's
constexpr float kMostDirect = 0.10f;  // W/m² of direct light that it bears
constexpr float kOpenEnough = 0.98f;  // of its petals: it has bloomed
constexpr float kStillOpen = 0.5f;    // until it wilts below this, its room counts it as open

FlowerMood moodIn(const Flower& flower, const render::ProbeLight& light);

void growFlowers(View<Flower, const render::ProbeLight> flowers, Res<const GameTime> time);
void openPetals(View<const Petal, LocalTransform> petals, Lookup<const Flower> flowers);

}  // namespace ag::game
