#include "game/frame_capture.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "engine/capture/save_capture.h"
#include "engine/capture/schedule_spans.h"
#include "engine/core/log.h"

namespace ag::game {
namespace {

constexpr uint32_t kWarmUp = 3;  // frames with nothing skipped: pipelines are there already
constexpr std::chrono::seconds kShown{8};

Status save(capture::Folder folder, const capture::Capture& seen) {
    return capture::saveCapture(folder, seen, capture::makeTable(seen), false);
}

std::string settingsText(const Demo& demo) {
    return fmt::format("the game, {} quality", qualityName(demo.user.quality));
}

bool isDone(const std::future<Status>& task) {
    return task.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

void FrameCapture::start(const Demo& demo) {
    if (recording() || writing_.valid()) return;
    path_ = fmt::format("{}/{:%Y-%m-%d_%H-%M-%S}", demo.files.captures(), fmt::localtime(std::time(nullptr)));
    auto folder = capture::Folder::open(path_);
    if (!folder) return say(folder.error().message);
    folder_.emplace(std::move(*folder));
    recorder_.emplace(renderer_, kWarmUp, demo.options.captureFrames);
    say(fmt::format("recording {} frames", demo.options.captureFrames));
}

void FrameCapture::noteSystems(const Schedule& schedule) {
    if (recording()) capture::noteSystems(schedule, systems_);
}

FrameGraphOptions FrameCapture::options(const FrameGraphOptions& asked) const {
    return recorder_ ? recorder_->options(asked) : asked;
}

void FrameCapture::declare(GraphScope scope, const render::RenderFrame& frame) {
    if (recorder_) recorder_->declare(scope, frame);
}

void FrameCapture::note(const Demo& demo, glm::uvec2 size) {
    if (!recorder_) return;
    recorder_->note(demo.game->scene(), std::exchange(systems_, {}));
    if (recorder_->complete()) finish(demo, size);
}

void FrameCapture::finish(const Demo& demo, glm::uvec2 size) {
    const gpu::DeviceInfo& device = renderer_.device().info();
    capture::Capture seen{.scene = demo.game->level().name,
                          .device = device.name,
                          .driver = device.driver,
                          .settings = settingsText(demo),
                          .size = size};
    recorder_->finish(seen);
    recorder_.reset();
    capture::describeSchedule(demo.game->tickSchedule(), seen);
    capture::describeSchedule(demo.game->frameSchedule(), seen);
    const capture::RecordSettings settings{.gi = demo.gi, .graph = demo.graph, .size = size};
    const std::string rdc = renderDoc_ ? folder_->place("frame.rdc") : "";
    const Status pictured =
        capture::recordPictures(renderer_, demo.game->scene(), settings, renderDoc_, rdc, seen);
    capture::Folder folder = std::move(*folder_);
    folder_.reset();
    if (!pictured) return say(pictured.error().message);
    say("writing " + path_);
    writing_ = std::async(std::launch::async, [folder = std::move(folder), seen = std::move(seen)]() mutable {
        return save(std::move(folder), seen);
    });
}

std::string FrameCapture::message() {
    if (writing_.valid() && isDone(writing_)) {
        const Status saved = writing_.get();
        say(saved ? fmt::format("captured: {}/report.html", path_) : saved.error().message);
    }
    const bool busy = recording() || writing_.valid();
    return busy || std::chrono::steady_clock::now() - said_ < kShown ? message_ : "";
}

void FrameCapture::say(std::string sentence) {
    spdlog::info("{}", sentence);
    message_ = std::move(sentence);
    said_ = std::chrono::steady_clock::now();
}

}  // namespace ag::game
