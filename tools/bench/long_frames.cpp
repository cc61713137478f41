#include "tools/bench/long_frames.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

namespace ag::bench {
namespace {

constexpr size_t kLongest = 10, kCulprits = 3;

std::string whyOf(const PassReport& pass) {
    if (pass.changed.empty()) return std::string(reasonText(pass.reason));
    return fmt::format("{}: {}", reasonText(pass.reason), pass.changed);
}

}  // namespace

Spread spreadOf(std::vector<double> values) {
    if (values.empty()) return {};
    std::ranges::sort(values);
    const auto at = [&](double share) { return values[size_t(share * double(values.size() - 1) + 0.5)]; };
    return {at(0.5), at(0.99), values.back()};
}

Spread DriveReport::of(double FrameCost::*part) const {
    std::vector<double> values;
    for (const FrameCost& frame : frames)
        values.push_back(frame.*part);
    return spreadOf(std::move(values));
}

void LongFrames::note(const FrameCost& cost) {
    frames_.push_back({{"CPU: world", {cost.world, ""}},
                       {"CPU: extraction", {cost.extract, ""}},
                       {"CPU: rendering", {cost.render, ""}}});
}

void LongFrames::note(const FrameGraph& graph) {
    Steps& now = frames_.back();
    frameOf_[graph.frame()] = frames_.size() - 1;
    for (const PassReport& pass : graph.report())
        if (pass.outcome == PassOutcome::kRan) now[std::string(pass.name)].why = whyOf(pass);
    const FrameSpans spans = graph.spans();
    const auto frame = frameOf_.find(spans.frame);
    if (frame == frameOf_.end()) return;
    for (const PassSpan& span : spans.passes)
        frames_[frame->second][std::string(span.name)].ms =
            double(span.endTicks - span.beginTicks) * spans.nsPerTick * 1e-6;
}

double LongFrames::medianOf(const std::string& step) const {
    std::vector<double> ran;
    for (const Steps& frame : frames_) {
        const auto found = frame.find(step);
        ran.push_back(found == frame.end() ? 0 : found->second.ms);
    }
    return spreadOf(std::move(ran)).median;
}

std::vector<Culprit> LongFrames::culpritsOf(const Steps& steps) const {
    std::vector<Culprit> culprits;
    for (const auto& [name, step] : steps)
        culprits.push_back({name, step.ms - medianOf(name), step.why});
    std::ranges::sort(culprits, std::greater(), &Culprit::excess);
    culprits.resize(std::min(culprits.size(), kCulprits));
    return culprits;
}

void LongFrames::finish(DriveReport& report) const {
    for (size_t i = 0; i < frames_.size(); ++i)
        for (const auto& [name, step] : frames_[i])
            if (!name.starts_with("CPU: ")) report.frames[i].device += step.ms;
    std::vector<uint32_t> order(frames_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, std::greater(), [&](uint32_t i) { return report.frames[i].whole; });
    order.resize(std::min(order.size(), kLongest));
    for (const uint32_t i : order)
        report.longest.push_back({i, report.frames[i].whole, culpritsOf(frames_[i])});
}

}  // namespace ag::bench
