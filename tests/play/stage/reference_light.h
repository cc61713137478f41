// What a flower's probe says where the walkthrough lights it, and what it should say, by path tracing.
#pragma once

#include "tests/play/stage/stage.h"

namespace ag::game {

// The scene as it was drawn when a flower had just opened.
struct LitFlower {
    RenderScene scene;  // of the stage's geometry
    RenderProbe probe;
    float amount = 0;  // W/m² that it wants
};

// Plays a recording; one for each flower that opened, in the order of the level.
std::vector<LitFlower> litFlowers(Stage& stage, std::span<const Input> inputs);

// By the renderer, after some frames. It must hold the stage's geometry.
gi::ProbeReading measureLight(render::Renderer& renderer, const LitFlower& lit,
                              const render::RenderSettings& settings, uint32_t frames);

// Mean over all directions, W/m²: straight from the lights that bounce, and of so many bounces.
// `unshadowed`: bounced light passes through surfaces. With `paths` in each of 128 directions the default's
// noise is some 2 %.
gi::ProbeReading referenceLight(const LitFlower& lit, uint32_t bounces, bool unshadowed = false,
                                uint32_t paths = 160);

}  // namespace ag::game
