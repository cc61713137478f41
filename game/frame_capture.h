// Frames of the running game as a capture in a folder of the player's: recorded as they come, then one more
// for the pictures, then written while the game goes on.
#pragma once

#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "engine/capture/folder.h"
#include "engine/capture/record.h"
#include "game/demo_options.h"

namespace ag::game {

class FrameCapture {
  public:
    // `renderDoc`: for frame.rdc, where it is at hand.
    FrameCapture(render::Renderer& renderer, gpu::RenderDoc renderDoc)
        : renderer_(renderer), renderDoc_(renderDoc) {}

    // Begins to record demo.options.captureFrames frames into a new folder, unless one is under way.
    void start(const Demo& demo);
    bool recording() const { return recorder_.has_value(); }

    // Around each frame, in this order.
    void noteSystems(const Schedule& schedule);  // after each run of one
    FrameGraphOptions options(const FrameGraphOptions& asked) const;
    void declare(GraphScope scope, const render::RenderFrame& frame);
    void note(const Demo& demo, glm::uvec2 size);  // when it was submitted

    // What there is to tell the player, for a few seconds; else empty.
    std::string message();

  private:
    void finish(const Demo& demo, glm::uvec2 size);
    void say(std::string sentence);

    render::Renderer& renderer_;
    gpu::RenderDoc renderDoc_;
    std::optional<capture::FrameRecorder> recorder_;
    std::optional<capture::Folder> folder_;
    std::string path_, message_;
    std::vector<capture::Span> systems_;  // of the next frame
    std::future<Status> writing_;
    std::chrono::steady_clock::time_point said_{};
};

}  // namespace ag::game
