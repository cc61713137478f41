// A scene as entities: each frame a schedule moves the camera and makes the renderer's view of the world
// anew, as a game does it. Times and graph of its systems go into the capture.
#pragma once

#include "engine/capture/capture.h"
#include "engine/ecs/schedule.h"
#include "engine/scene/render_scene.h"
#include "engine/scene/scene_asset.h"

namespace ag::capture {

class WorldSource {
  public:
    // The camera is that of `asked`, lights are the asset's own. `step`: m a frame.
    WorldSource(const SceneAsset& asset, const RenderScene& asked, glm::uvec2 size, glm::vec3 step);
    const RenderScene& next(std::vector<Span>& systems);
    Schedule& schedule() { return schedule_; }

  private:
    World world_;
    Schedule schedule_;
    JobRunner runner_;
};

}  // namespace ag::capture
