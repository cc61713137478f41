// A number that changes with whatever changes the picture, but for where things stand.
#pragma once

#include "engine/renderer/render_settings.h"
#include "engine/scene/render_scene.h"

namespace ag::render {

class PictureVersion {
  public:
    // Once a frame.
    uint64_t next(const RenderScene& scene, const RenderSettings& settings);

  private:
    RenderSettings settings_;  // of the frame before
    std::shared_ptr<const Sky> sky_;
    uint64_t changes_ = 0;  // of those two
};

}  // namespace ag::render
