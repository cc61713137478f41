// The same view by another preset, rendered beside the first.
#pragma once

#include <memory>
#include <string>

#include "engine/renderer/renderer.h"
#include "tools/viewer/beside.h"

namespace ag::viewer {

// Of the passes of its last frame that ran, ms.
double passesMs(const FrameGraph& graph);

class PresetView {
  public:
    // One more frame of the scene by the preset, before ours, anti-aliased alike. Blocking where the preset
    // or the size changed.
    void render(const RenderScene& scene, glm::uvec2 size, const std::string& preset,
                const render::AntialiasingSettings& antialiasing, const FrameGraphOptions& options,
                gpu::Device& device);
    void forget();
    void loadMaterials(const GeometryArrays& geometry);  // see Renderer
    bool isOn() const { return renderer_ != nullptr; }
    double gpuMs() const { return passesMs(renderer_->graph()); }

    ImageHandle add(GraphScope scope, const render::SceneView& view, const render::RenderFrame& frame,
                    const render::CompositeSettings& composite, const BesideSettings& settings) const;

  private:
    std::unique_ptr<render::Renderer> renderer_;
    std::string preset_;
    glm::uvec2 size_{0};
    ImageHandle radiance_;
    uint64_t version_ = 0;  // of its picture
};

}  // namespace ag::viewer
