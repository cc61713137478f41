#include "engine/capture/record.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "engine/capture/made_anew.h"
#include "engine/frame/frame_timer.h"

namespace ag::capture {
namespace {

// Device ticks to the host's clock, by the moments at both ends: neither clock has to keep perfect time.
struct ClockMap {
    gpu::ClockPair from, to;

    uint64_t hostNs(uint64_t ticks) const {
        const double share =
            double(int64_t(ticks - from.deviceTicks)) / double(to.deviceTicks - from.deviceTicks);
        return from.hostNs + uint64_t(int64_t(share * double(to.hostNs - from.hostNs)));
    }
};

// Without a common clock: the first pass of all began when its frame was submitted.
ClockMap alignedClocks(const std::vector<Frame>& frames, float periodNs) {
    for (const Frame& frame : frames) {
        if (frame.gpu.empty()) continue;
        const gpu::ClockPair from{frame.gpu.front().beginNs, frame.cpu.submitted};
        constexpr uint64_t kTicks = 1'000'000'000;
        return {from, {from.deviceTicks + kTicks, from.hostNs + uint64_t(double(kTicks) * double(periodNs))}};
    }
    return {{0, 0}, {1, 1}};
}

uint64_t facesDrawn(const Frame& frame) {
    uint64_t drawn = 0;
    for (const PassDescription& pass : frame.passes)
        drawn += pass.patchesDrawn;
    return drawn;
}

double countOf(const Frame& frame, PassOutcome outcome) {
    return double(std::ranges::count(frame.passes, outcome, &PassDescription::outcome));
}

uint64_t entitiesChanged(const RenderScene& scene) {
    if (scene.allInstancesChanged) return scene.instances.size();
    uint64_t changed = 0;
    for (const RenderScene::Range& rows : scene.changedInstances)
        changed += rows.end - rows.begin;
    return changed;
}

std::vector<Counter> countersOf(render::Renderer& renderer, const RenderScene& scene,
                                const render::RenderFrame& declared, const Frame& frame) {
    return {{"shadow map tiles of area lights", double(declared.bounce.isms.mapCount)},
            {"punctual lights in view", double(declared.punctual.lists.lightCount)},
            {"punctual light shadow faces redrawn", double(facesDrawn(frame))},
            {"entities changed", double(entitiesChanged(scene))},
            {"bytes uploaded", double(renderer.scene().uploadedBytes())},
            {"passes run", countOf(frame, PassOutcome::kRan)},
            {"passes skipped", countOf(frame, PassOutcome::kSkipped)}};
}

// Copies that only the capture asks for; they are no part of the frame.
constexpr std::string_view kOwnPrefix = "capture.";
constexpr std::array<std::string_view, kFramesInFlight> kValCopies = {"capture.vals0", "capture.vals1"};
constexpr std::array<std::string_view, kFramesInFlight> kMapCopies = {"capture.maps0", "capture.maps1"};

template <class Row>
uint64_t countRows(std::span<const std::byte> bytes, bool (*counts)(const Row&)) {
    uint64_t count = 0;
    for (; bytes.size() >= sizeof(Row); bytes = bytes.subspan(sizeof(Row))) {
        Row row;
        std::memcpy(&row, bytes.data(), sizeof row);
        count += counts(row);
    }
    return count;
}

bool ran(const Frame& frame, std::string_view pass) {
    return std::ranges::any_of(frame.passes, [&](const PassDescription& p) {
        return p.name == pass && p.outcome == PassOutcome::kRan;
    });
}

// Whether the frame makes a buffer anyhow: reading it back must not be what it is made for.
bool isMade(const FrameDescription& frame, BufferHandle buffer) {
    return buffer && std::ranges::any_of(frame.passes, [&](const PassDescription& p) {
               return p.outcome != PassOutcome::kDropped && std::ranges::count(p.writes, buffer.index) > 0;
           });
}

}  // namespace

FrameRecorder::FrameRecorder(render::Renderer& renderer, uint32_t warmUp, uint32_t frames)
    : renderer_(renderer),
      warmUp_(warmUp),
      recorded_(warmUp + frames),
      start_(renderer.device().readClocks()) {}

FrameGraphOptions FrameRecorder::options(const FrameGraphOptions& asked) const {
    FrameGraphOptions options = asked;
    options.skip = asked.skip && rendered_ >= warmUp_;
    options.timing = TimingMode::kBracketed;
    return options;
}

bool FrameRecorder::complete() const {
    return rendered_ >= recorded_ + kTimerFrames;
}

void FrameRecorder::declare(GraphScope scope, const render::RenderFrame& frame) {
    declared_ = frame;
    // The very last frame is as the program declares it, for the graph's picture.
    if (rendered_ < recorded_ + kFramesInFlight) takeReadBack(scope, frame);
}

// What the frame before last held, as known by now.
void FrameRecorder::takeReadBack(GraphScope scope, const render::RenderFrame& declared) {
    std::span<const std::byte> vals, maps;
    if (readVals_) vals = scope.readBack(kValCopies, declared.bounce.vals.vals);
    if (readMaps_) maps = scope.readBack(kMapCopies, declared.bounce.isms.states);
    const auto frame = std::ranges::find(frames_, scope.graph().frame() - kFramesInFlight, &Frame::number);
    if (frame == frames_.end()) return;
    if (!vals.empty())
        frame->counters.push_back({"area lights", double(countRows<io::Val>(vals, [](const io::Val& val) {
                                       return val.flux.x + val.flux.y + val.flux.z > 0;
                                   }))});
    if (maps.empty()) return;
    double splatted = 0;
    if (ran(*frame, "ism_atlas.splat"))
        splatted = double(countRows<io::IsmMapState>(
            maps, [](const io::IsmMapState& map) { return map.pointCount > 0 && map.kept == 0; }));
    if (ran(*frame, "ism_atlas.splat_movable"))
        splatted = double(declared.bounce.isms.mapCount);  // over the others
    frame->counters.push_back({"shadow map tiles splatted", splatted});
}

// Spans stay in ticks of the device until the recording ends: only then are its clock and the host's read at
// both ends.
void FrameRecorder::takeSpans() {
    const FrameSpans spans = renderer_.graph().spans();
    const auto frame = std::ranges::find(frames_, spans.frame, &Frame::number);
    if (frame == frames_.end() || !frame->gpu.empty()) return;
    for (const PassSpan& pass : spans.passes)
        if (!pass.name.starts_with(kOwnPrefix))
            frame->gpu.push_back({std::string(pass.name), pass.beginTicks, pass.endTicks});
}

void FrameRecorder::note(const RenderScene& scene, std::vector<Span> systems) {
    takeSpans();
    const uint32_t index = rendered_++;
    if (index >= recorded_) return;
    FrameDescription description = renderer_.graph().describe();
    if (index == 0) {
        readVals_ = isMade(description, declared_.bounce.vals.vals);
        readMaps_ = isMade(description, declared_.bounce.isms.states);
    }
    std::erase_if(description.passes,
                  [](const PassDescription& pass) { return pass.name.starts_with(kOwnPrefix); });
    std::vector<std::string> anew = madeAnew(description);
    resources_ = std::move(description.resources);
    Frame frame{.number = renderer_.graph().frame(),
                .forced = index < warmUp_,
                .cpu = renderer_.moments(),
                .passes = std::move(description.passes),
                .systems = std::move(systems),
                .madeAnew = std::move(anew)};
    frame.counters = countersOf(renderer_, scene, declared_, frame);
    frames_.push_back(std::move(frame));
}

void FrameRecorder::finish(Capture& capture) {
    gpu::Device& device = renderer_.device();
    renderer_.waitIdle();
    const auto end = device.readClocks();
    const bool calibrated = start_ && end;
    const ClockMap clocks =
        calibrated ? ClockMap{*start_, *end} : alignedClocks(frames_, device.info().timestampPeriodNs);
    capture.clock = calibrated
                        ? "VK_EXT_calibrated_timestamps"
                        : "not calibrated: the first pass is set to begin when its frame was submitted";
    for (Frame& frame : frames_)
        for (Span& span : frame.gpu)
            span = {span.name, clocks.hostNs(span.beginNs), clocks.hostNs(span.endNs)};
    capture.frames = std::move(frames_);
    capture.resources = std::move(resources_);
    capture.frameDot = renderer_.graph().graphviz();
}

void recordFrames(render::Renderer& renderer, NextScene next, const RecordSettings& settings,
                  Capture& capture) {
    capture.gi = settings.gi;
    FrameRecorder recorder(renderer, settings.warmUp, settings.frames);
    while (!recorder.complete()) {
        std::vector<Span> systems;
        const RenderScene& scene = next(systems);
        renderer.render(scene, settings.size, settings.gi, recorder.options(settings.graph),
                        [&](GraphScope scope, const render::SceneView&, const render::RenderFrame& frame) {
                            scope.output(frame.outputs.display);
                            recorder.declare(scope, frame);
                        });
        recorder.note(scene, std::move(systems));
    }
    recorder.finish(capture);
}

}  // namespace ag::capture
