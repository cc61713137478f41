// Notes what each step of some frames did when, and what the last one made.
#pragma once

#include "engine/capture/capture.h"
#include "engine/core/function_ref.h"
#include "engine/gpu/renderdoc.h"

namespace ag::capture {

struct RecordSettings {
    render::RenderSettings gi;
    FrameGraphOptions graph;
    glm::uvec2 size{640, 360};
    uint32_t warmUp = 6;   // frames before, with nothing skipped: pipelines get made, every pass gets a time
    uint32_t frames = 32;  // of which the table is made
};

// Watches frames that its owner renders, two in flight as ever.
class FrameRecorder {
  public:
    FrameRecorder(render::Renderer& renderer, uint32_t warmUp, uint32_t frames);

    // For the next frame: as asked, but with nothing skipped while warming up.
    FrameGraphOptions options(const FrameGraphOptions& asked) const;
    // At the end of the frame's declaration.
    void declare(GraphScope scope, const render::RenderFrame& frame);
    // After it was submitted; `systems`: of the schedule that made the scene, if one did.
    void note(const RenderScene& scene, std::vector<Span> systems);
    // The frames are there, and a few more that only brought the times of those before.
    bool complete() const;
    // Frames, resources and graph into the capture; waits for the device.
    void finish(Capture& capture);

  private:
    void takeSpans();
    void takeReadBack(GraphScope scope, const render::RenderFrame& frame);

    render::Renderer& renderer_;
    uint32_t warmUp_, recorded_, rendered_ = 0;
    std::optional<gpu::ClockPair> start_;
    render::RenderFrame declared_;
    std::vector<Frame> frames_;
    std::vector<ResourceDescription> resources_;
    bool readVals_ = false, readMaps_ = false;
};

// The scene of the next frame; a schedule that makes it leaves its systems' spans.
using NextScene = FunctionRef<const RenderScene&(std::vector<Span>& systems)>;

// Renders frames and records them.
void recordFrames(render::Renderer& renderer, NextScene next, const RecordSettings& settings,
                  Capture& capture);

// Pictures and counts: one frame in which no memory is shared and nothing is skipped, read back, and one for
// each debug view of a buffer. RenderDoc, where it is at hand, captures the first into `rdcPath`.
Status recordPictures(render::Renderer& renderer, const RenderScene& scene, const RecordSettings& settings,
                      gpu::RenderDoc renderDoc, const std::string& rdcPath, Capture& capture);

}  // namespace ag::capture
