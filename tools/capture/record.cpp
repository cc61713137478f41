#include "tools/capture/record.h"

#include <algorithm>

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

void noteCounters(gi::GiRenderer& renderer, const gi::GiFrame& declared, Frame& frame) {
    frame.counters = {{"area lights", double(declared.vals.count)},
                      {"shadow map tiles of area lights", double(declared.isms.mapCount)},
                      {"lamps in view", double(declared.lampLists.lampCount)},
                      {"lamp shadow faces redrawn", double(facesDrawn(frame))},
                      {"bytes uploaded", double(renderer.scene().uploadedBytes())},
                      {"passes run", countOf(frame, PassOutcome::kRan)},
                      {"passes skipped", countOf(frame, PassOutcome::kSkipped)}};
}

// Ticks for now: they go to the host's clock when both ends are known.
void takeSpans(const FrameGraph& graph, std::vector<Frame>& frames) {
    const FrameSpans spans = graph.spans();
    for (Frame& frame : frames) {
        if (frame.number != spans.frame || !frame.gpu.empty()) continue;
        for (const PassSpan& pass : spans.passes)
            frame.gpu.push_back({std::string(pass.name), pass.beginTicks, pass.endTicks});
    }
}

}  // namespace

void recordFrames(gi::GiRenderer& renderer, NextScene next, const RecordSettings& settings,
                  Capture& capture) {
    gpu::Device& device = renderer.device();
    const auto start = device.readClocks();
    const uint32_t recorded = settings.warmUp + settings.frames;
    // The last ones only bring the times of those before.
    for (uint32_t i = 0; i < recorded + kTimerFrames; ++i) {
        Frame frame{.forced = i < settings.warmUp};
        FrameGraphOptions options = settings.graph;
        options.skip = options.skip && !frame.forced;
        const RenderScene& scene = next(frame.systems);
        gi::GiFrame declared;
        renderer.render(scene, settings.size, settings.gi, options,
                        [&](FrameGraph& graph, const gi::SceneView&, const gi::GiFrame& f) {
                            declared = f;
                            graph.output(f.outputs.display);
                        });
        takeSpans(renderer.graph(), capture.frames);
        if (i >= recorded) continue;
        frame.number = renderer.graph().frame();
        frame.cpu = renderer.moments();
        FrameDescription description = renderer.graph().describe();
        frame.passes = std::move(description.passes);
        capture.resources = std::move(description.resources);
        noteCounters(renderer, declared, frame);
        capture.frames.push_back(std::move(frame));
    }
    capture.frameDot = renderer.graph().graphviz();
    renderer.waitIdle();
    const auto end = device.readClocks();
    const ClockMap clocks = start && end ? ClockMap{*start, *end}
                                         : alignedClocks(capture.frames, device.info().timestampPeriodNs);
    capture.clock = start && end
                        ? "VK_EXT_calibrated_timestamps"
                        : "not calibrated: the first pass is set to begin when its frame was submitted";
    for (Frame& frame : capture.frames)
        for (Span& span : frame.gpu)
            span = {span.name, clocks.hostNs(span.beginNs), clocks.hostNs(span.endNs)};
}

}  // namespace ag::capture
