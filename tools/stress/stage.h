// A scene and a renderer of its own, and what must hold of each of its frames.
#pragma once

#include <optional>
#include <string>

#include "engine/renderer/renderer.h"
#include "engine/scene/static_scene.h"

namespace ag::stress {

class Stage {
  public:
    Stage(gpu::Device& device, SceneAsset asset, glm::uvec2 size, uint32_t mapResolution);

    void frame();
    void frames(uint32_t count);
    glm::vec3 place(glm::dvec3 world) const { return glm::vec3(world - scene.originWorld); }
    Image radiance();  // W/(m² sr), of the last frame
    // The first thing wrong with the last frame: a number that is none, or an invariant of clustering that
    // does not hold (every lit texel in one cluster, fluxes that add up). Nothing if all is well.
    std::optional<std::string> fault();
    uint32_t litTexels();

    SceneAsset asset;
    RenderScene scene;
    glm::uvec2 size;
    render::RenderSettings settings;
    FrameGraphOptions options{.timing = TimingMode::kOff};
    render::Renderer renderer;

  private:
    template <class T>
    std::vector<T> read(BufferHandle buffer);
    std::optional<std::string> clusterFault();

    render::RenderFrame last_;
    ImageHandle radiance_;
};

}  // namespace ag::stress
