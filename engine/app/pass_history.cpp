#include "engine/app/pass_history.h"

#include <algorithm>

namespace ag {
namespace {

constexpr size_t kLeastFrames = 8;  // before anything is unusual

double medianOf(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

}  // namespace

size_t PassHistory::techniqueOf(std::string_view pass) {
    const std::string_view name = pass.substr(0, pass.find('.'));
    const auto known = std::ranges::find(techniques_, name);
    if (known != techniques_.end()) return size_t(known - techniques_.begin());
    techniques_.emplace_back(name);
    return techniques_.size() - 1;
}

void PassHistory::add(const FrameSpans& spans, double budgetMs) {
    if (spans.frame == 0 || (!frames_.empty() && frames_.back().frame == spans.frame)) return;
    FrameCost cost{.frame = spans.frame};
    for (const PassSpan& pass : spans.passes) {
        const double ms = double(pass.endTicks - pass.beginTicks) * spans.nsPerTick * 1e-6;
        const size_t technique = techniqueOf(pass.name);
        cost.techniques.resize(std::max(cost.techniques.size(), technique + 1));
        cost.techniques[technique] += float(ms);
        cost.ms += ms;
        if (ms <= cost.worstMs) continue;
        cost.worstMs = ms;
        cost.worst = pass.name;
    }
    if (frames_.size() >= kLeastFrames && cost.ms > budgetMs && cost.ms > kSpikeRatio * medianMs())
        keepSpike(cost);
    frames_.push_back(std::move(cost));
    if (frames_.size() > kFrames) frames_.pop_front();
}

void PassHistory::keepSpike(const FrameCost& frame) {
    const auto longer = [](const FrameCost& a, const FrameCost& b) { return a.ms > b.ms; };
    spikes_.insert(std::ranges::upper_bound(spikes_, frame, longer), frame);
    if (spikes_.size() > kSpikes) spikes_.pop_back();
}

double PassHistory::medianMs() const {
    std::vector<double> ms;
    for (const FrameCost& frame : frames_)
        ms.push_back(frame.ms);
    return medianOf(std::move(ms));
}

double PassHistory::medianMs(size_t technique) const {
    std::vector<double> ms;
    for (const FrameCost& frame : frames_)
        ms.push_back(technique < frame.techniques.size() ? double(frame.techniques[technique]) : 0.0);
    return medianOf(std::move(ms));
}

}  // namespace ag
