// The game with its renderer, tick by tick, without a window: what the headless demo does, for scripts and
// tests.
#pragma once

#include <functional>

#include "engine/renderer/probe_components.h"
#include "engine/renderer/renderer.h"
#include "game/game.h"
#include "game/quality.h"

namespace ag::game {

struct Stage {
    Stage(gpu::Device& device, SceneAsset level, uint32_t ticksPerFrame, glm::uvec2 pixels = {64, 36});

    void tick(const Input& input);
    // After each tick.
    std::function<void()> watch = [] {};
    Image picture();              // the frame that was rendered last
    Flower flower(size_t index);  // in the order of the level
    render::ProbeLight lightAt(size_t index);
    glm::dvec3 flowerAt(size_t index);  // m, of its head

    Game game;
    render::RenderSettings settings;
    FrameGraphOptions options;
    render::Renderer renderer;
    ImageHandle shown;
    glm::uvec2 size;
    uint32_t perFrame;
    uint64_t ticks = 0;
    std::vector<Entity> flowers;

  private:
    void show();
};

SceneAsset shippedLevel();

}  // namespace ag::game
