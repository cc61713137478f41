// Path tracing beside the renderer: follows what is seen, shows its picture beside ours or how far they are
// apart, and says so in numbers.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "engine/renderer/renderer.h"
#include "tools/viewer/beside.h"
#include "tools/viewer/live_truth.h"

namespace ag::viewer {

// The path tracer's filter for a picture that is made so.
reference::PixelFilter filterOf(const render::AntialiasingSettings& settings);

class TruthView {
  public:
    // Before a frame of the scene. Takes what was traced meanwhile to the device, blocking; true: there is a
    // better picture, whose numbers are due.
    bool follow(const RenderScene& scene, glm::uvec2 size, reference::PixelFilter filter, bool on,
                gpu::Device& device);
    // Nobody reads the scene until it is followed again.
    void pause();
    // What is to be shown, and our radiance as an output of the frame. Ours alone where there is no picture.
    ImageHandle add(GraphScope scope, const render::SceneView& view, const render::RenderFrame& frame,
                    const render::CompositeSettings& composite, const BesideSettings& settings);
    // Once that frame was submitted.
    void compare(render::Renderer& renderer);
    // The renderer made another frame since: there is none to compare.
    void forgetFrame() { radiance_ = {}; }

    const TruthPicture* picture() const { return picture_.get(); }
    const std::string& numbers() const { return numbers_; }
    // Its halves and our radiance of the last frame as `compare` takes them: STEM_1.exr, STEM_2.exr,
    // STEM_ours.exr. Returns what `compare` says of them, a line a number.
    Result<std::string> save(render::Renderer& renderer, const std::string& stem) const;

  private:
    void take(std::shared_ptr<const TruthPicture> picture, gpu::Device& device);

    std::optional<LiveTruth> tracing_;  // while it is asked for
    std::shared_ptr<const TruthPicture> picture_;
    std::unique_ptr<gpu::Image> image_;
    uint64_t version_ = 0;
    float mean_ = 0;  // W/(m² sr)
    ImageHandle radiance_;
    std::string numbers_;
};

}  // namespace ag::viewer
