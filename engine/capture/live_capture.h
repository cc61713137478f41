// Frames of a running program as a capture in a folder: recorded as they come, then one more for the
// pictures, then written while the program goes on.
#pragma once

#include <chrono>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "engine/capture/folder.h"
#include "engine/capture/record.h"
#include "engine/ecs/schedule.h"

namespace ag::capture {

// What the program showed in a frame.
struct Subject {
    const RenderScene& scene;
    std::string name, settings;  // of the scene, and a few words
    const render::RenderSettings& gi;
    const FrameGraphOptions& graph;
    glm::uvec2 size{0};
    std::vector<Schedule*> schedules;  // that made the scene
};

class LiveCapture {
  public:
    // `renderDoc`: for frame.rdc, where it is at hand.
    LiveCapture(render::Renderer& renderer, gpu::RenderDoc renderDoc)
        : renderer_(renderer), renderDoc_(renderDoc) {}

    // Begins to record so many frames into a new folder, named by the time, in `folder`; unless one is under
    // way.
    void start(const std::string& folder, uint32_t frames);
    bool recording() const { return recorder_.has_value(); }

    // Around each frame, in this order.
    void noteSystems(const Schedule& schedule);  // after each run of one
    FrameGraphOptions options(const FrameGraphOptions& asked) const;
    void declare(GraphScope scope, const render::RenderFrame& frame);
    // When it was submitted, while recording. True: others were rendered after it, for the pictures, so that
    // its handles are worth nothing any more.
    bool note(const Subject& subject);

    // What there is to tell the user, for a few seconds; else empty.
    std::string message();

  private:
    void finish(const Subject& subject);
    void say(std::string sentence);

    render::Renderer& renderer_;
    gpu::RenderDoc renderDoc_;
    std::optional<FrameRecorder> recorder_;
    std::optional<Folder> folder_;
    std::string path_, message_;
    std::vector<Span> systems_;  // of the next frame
    std::future<Status> writing_;
    std::chrono::steady_clock::time_point said_{};
};

}  // namespace ag::capture
