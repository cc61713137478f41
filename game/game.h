// A level being played: the world, its schedules, one tick of time, one frame of pictures. Knows no window
// and no device.
#pragma once

#include <memory>

#include "engine/app/input.h"
#include "engine/ecs/world.h"
#include "engine/jobs/job_graph.h"
#include "engine/scene/scene_asset.h"
#include "game/components.h"
#include "game/schedule.h"
#include "game/sounds.h"
#include "gi/probes.h"

namespace ag::game {

class Game {
  public:
    // `threads` 1: everything in order on the caller; 0: as many as the machine has.
    Game(SceneAsset level, uint32_t threads);

    void tick(const Input& input);
    // `share` of the way from the tick before to the last one: 1 shows the world as it is.
    void frame(glm::uvec2 viewSize, float share = 1);
    // What the renderer measured, for the next tick.
    void takeReadings(const gi::ProbeReadings& readings);

    const RenderScene& scene() const { return world_.resource<RenderScene>(); }
    const Player& player() const { return world_.resource<Player>(); }
    const Progress& progress() const { return world_.resource<Progress>(); }
    std::span<const Sound> sounds() const;  // of the last tick
    const std::vector<Hint>& hints() const { return hints_; }
    const SceneAsset& level() const { return level_; }
    World& world() { return world_; }
    Schedule& tickSchedule() { return tick_; }
    Schedule& frameSchedule() { return frame_; }
    uint64_t stateHash() const { return world_.stateHash(); }

  private:
    SceneAsset level_;
    World world_;
    Schedule tick_, frame_;
    JobRunner runner_;
    std::vector<Hint> hints_;
};

}  // namespace ag::game
