// Flowers: they open in bounced light of their colour, and close in direct light.
#pragma once

#include "engine/ecs/view.h"
#include "engine/renderer/probe_components.h"
#include "engine/scene/components.h"
#include "game/components.h"

namespace ag::game {

constexpr float kLeastMatch = 0.92f;  // cosine between a flower's colour and the light's
constexpr float kMostDirect = 0.10f;  // W/m² of direct light that it bears
constexpr float kEdge = 0.15f;        // of a beam's strength: what has less of it is the beam's soft edge
constexpr float kOpenEnough = 0.98f;  // of its petals: it has bloomed
constexpr float kStillOpen = 0.5f;    // until it wilts below this, its room counts it as open

// `direct`: W/m² of the direct light that counts.
FlowerMood moodIn(const Flower& flower, const render::ProbeLight& light, float direct);
// How near that light is to opening it: 1 where its mood is kGrowing, and continuous in the light.
float promiseIn(const Flower& flower, const render::ProbeLight& light, float direct);
// W/m², mean over directions, that a light's soft edge sends to a point where nothing is in its way; 0 in the
// beam itself and outside of its cone.
float softEdge(const PunctualLight& light, const LocalTransform& at, glm::dvec3 point);

void growFlowers(View<Flower, const render::ProbeLight, const LocalTransform> flowers,
                 View<const PunctualLight, const BounceLight, const LocalTransform> lights,
                 Res<const Progress> progress, Res<const GameTime> time);
void growHearts(View<const FlowerHeart, LocalTransform> hearts, Lookup<const Flower> flowers);
void openPetals(View<const Petal, LocalTransform> petals, Lookup<const Flower> flowers);

}  // namespace ag::game
