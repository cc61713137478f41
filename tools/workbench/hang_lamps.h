// Lamps hung in the free space of any scene, to see how a place copes with many of them.
#pragma once

#include <cstdint>

#include "engine/scene/render_scene.h"

namespace ag::workbench {

constexpr uint32_t kMostHungLamps = 100'000;

// Points of light of many colours, the same ones every time, spread evenly wherever there is a floor below
// and surfaces nearly all about, and nothing close by. Their range lets about ten of them reach any place.
// Returns how many found a place: fewer than asked for in scenes without a roof or walls, at worst none.
uint32_t hangLamps(RenderScene& scene, uint32_t count);

}  // namespace ag::workbench
