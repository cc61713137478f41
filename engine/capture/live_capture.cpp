#include "engine/capture/live_capture.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "engine/capture/save_capture.h"
#include "engine/capture/schedule_spans.h"
#include "engine/core/log.h"

namespace ag::capture {
namespace {

constexpr uint32_t kWarmUp = 3;  // frames with nothing skipped: pipelines are there already
constexpr std::chrono::seconds kShown{8};

bool isDone(const std::future<Status>& task) {
    return task.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

void LiveCapture::start(const std::string& where, uint32_t frames) {
    if (recording() || writing_.valid()) return;
    path_ = fmt::format("{}/{:%Y-%m-%d_%H-%M-%S}", where, fmt::localtime(std::time(nullptr)));
    auto folder = Folder::open(path_);
    if (!folder) return say(folder.error().message);
    folder_.emplace(std::move(*folder));
    recorder_.emplace(renderer_, kWarmUp, frames);
    say(fmt::format("recording {} frames", frames));
}

void LiveCapture::noteSystems(const Schedule& schedule) {
    if (recording()) capture::noteSystems(schedule, systems_);
}

FrameGraphOptions LiveCapture::options(const FrameGraphOptions& asked) const {
    return recorder_ ? recorder_->options(asked) : asked;
}

void LiveCapture::declare(GraphScope scope, const render::RenderFrame& frame) {
    if (recorder_) recorder_->declare(scope, frame);
}

bool LiveCapture::note(const Subject& subject) {
    if (!recorder_) return false;
    recorder_->note(subject.scene, std::exchange(systems_, {}));
    if (!recorder_->complete()) return false;
    finish(subject);
    return true;
}

void LiveCapture::finish(const Subject& subject) {
    const gpu::DeviceInfo& device = renderer_.device().info();
    Capture seen{.scene = subject.name,
                 .device = device.name,
                 .driver = device.driver,
                 .settings = subject.settings,
                 .size = subject.size,
                 .gi = subject.gi};
    recorder_->finish(seen);
    recorder_.reset();
    for (Schedule* schedule : subject.schedules)
        describeSchedule(*schedule, seen);
    const RecordSettings settings{.gi = subject.gi, .graph = subject.graph, .size = subject.size};
    const std::string rdc = renderDoc_ ? folder_->place("frame.rdc") : "";
    const Status pictured = recordPictures(renderer_, subject.scene, settings, renderDoc_, rdc, seen);
    Folder folder = std::move(*folder_);
    folder_.reset();
    if (!pictured) return say(pictured.error().message);
    say("writing " + path_);
    writing_ = std::async(std::launch::async, [folder = std::move(folder), seen = std::move(seen)]() mutable {
        return saveCapture(folder, seen, makeTable(seen), false);
    });
}

std::string LiveCapture::message() {
    if (writing_.valid() && isDone(writing_)) {
        const Status saved = writing_.get();
        say(saved ? fmt::format("captured: {}/report.html", path_) : saved.error().message);
    }
    const bool busy = recording() || writing_.valid();
    return busy || std::chrono::steady_clock::now() - said_ < kShown ? message_ : "";
}

void LiveCapture::say(std::string sentence) {
    spdlog::info("{}", sentence);
    message_ = std::move(sentence);
    said_ = std::chrono::steady_clock::now();
}

}  // namespace ag::capture
