// A level being played: the world, its schedule, and one tick of time. Knows no window and no device.
#pragma once

#include <memory>

#include "engine/app/input.h"
#include "engine/ecs/world.h"
#include "engine/jobs/job_graph.h"
#include "engine/scene/scene_asset.h"
#include "game/components.h"
#include "game/schedule.h"

namespace ag::game {

class Game {
  public:
    // `threads` 1: everything in order on the caller; 0: as many as the machine has.
    Game(SceneAsset level, uint32_t threads);

    void tick(const Input& input, glm::uvec2 viewSize);
    const RenderScene& scene() const { return world_.resource<RenderScene>(); }
    const Player& player() const { return world_.resource<Player>(); }
    const SceneAsset& level() const { return level_; }
    World& world() { return world_; }
    Schedule& schedule() { return schedule_; }
    uint64_t stateHash() const { return world_.stateHash(); }

  private:
    SceneAsset level_;
    World world_;
    Schedule schedule_;
    JobRunner runner_;
};

}  // namespace ag::game
