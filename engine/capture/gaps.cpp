#include "engine/capture/gaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace ag::capture {
namespace {

constexpr uint64_t kShortestNs = 50'000;
constexpr uint64_t kShortestShare = 50;  // of the frame: one in so many

double ms(uint64_t ns) {
    return double(ns) * 1e-6;
}

const Frame* frameBefore(std::span<const Frame> frames, size_t index, size_t by) {
    if (index < by) return nullptr;
    const Frame& before = frames[index - by];
    return before.number + by == frames[index].number ? &before : nullptr;
}

// From the first of its steps to the last.
uint64_t lengthOf(const Frame& f) {
    const uint64_t end = f.gpu.empty() ? f.cpu.submitted : std::max(f.cpu.submitted, f.gpu.back().endNs);
    return end - f.cpu.begin;
}

// What the frame loop did in most of a stretch before the frame was submitted.
std::string busyWith(const Frame& f, const Frame* before, uint64_t begin, uint64_t end) {
    struct Step {
        uint64_t begin, end;
        const char* words;
    };
    const std::array steps = {
        Step{before ? before->cpu.submitted : 0, f.cpu.begin, "did other things than rendering"},
        Step{f.cpu.begin, f.cpu.waited, "waited for the frame before last"},
        Step{f.cpu.waited, f.cpu.declared, "declared the passes"},
        Step{f.cpu.declared, f.cpu.recorded, "planned and recorded them"},
        Step{f.cpu.recorded, f.cpu.submitted, "submitted them"}};
    const auto within = [&](const Step& s) {
        const uint64_t from = std::max(s.begin, begin), to = std::min(s.end, end);
        return to > from ? to - from : 0;
    };
    const Step& most = *std::ranges::max_element(steps, {}, within);
    return fmt::format("{} for {:.2f} ms of it", most.words, ms(within(most)));
}

// A system of the schedule that took the most of a stretch, if any did.
std::string systemIn(const Frame& f, uint64_t begin, uint64_t end) {
    const Span* most = nullptr;
    for (const Span& s : f.systems)
        if (s.beginNs >= begin && s.endNs <= end &&
            (!most || s.endNs - s.beginNs > most->endNs - most->beginNs))
            most = &s;
    return most ? fmt::format("; longest was {} with {:.2f} ms", most->name, ms(most->endNs - most->beginNs))
                : "";
}

Gap waitOfLoop(const Frame& f, const Frame* last) {
    std::string why =
        fmt::format("the processor waited {:.2f} ms for frame {}, whose memory this one takes over",
                    ms(f.cpu.waited - f.cpu.begin), f.number - 2);
    if (last && !last->gpu.empty() && last->gpu.back().endNs > f.cpu.begin)
        why += fmt::format(": the device was still at it, last at {}", last->gpu.back().name);
    return {Gap::Of::kFrameLoop, f.cpu.begin, f.cpu.waited, why + "."};
}

Gap betweenLoops(const Frame& f, const Frame& before) {
    const uint64_t begin = before.cpu.submitted, end = f.cpu.begin;
    return {
        Gap::Of::kFrameLoop, begin, end,
        fmt::format("{:.2f} ms went by between two frames: the program did other things than rendering{}.",
                    ms(end - begin), systemIn(f, begin, end))};
}

Gap beforeFirstPass(const Frame& f, const Frame& before) {
    const uint64_t begin = before.gpu.back().endNs, end = f.gpu.front().beginNs;
    const uint64_t handed = std::clamp(f.cpu.recorded, begin, end);
    const std::string idle = fmt::format("the device had nothing to do for {:.2f} ms", ms(end - begin));
    const std::string why =
        handed - begin >= (end - begin) / 2
            ? fmt::format("{} until frame {} was submitted: the processor {}", idle, f.number,
                          busyWith(f, &before, begin, handed))
            : fmt::format("{}: frame {} was submitted, and its driver took {:.2f} ms to begin", idle,
                          f.number, ms(end - handed));
    return {Gap::Of::kDevice, begin, end, why + "."};
}

Gap betweenPasses(const Span& a, const Span& b) {
    return {Gap::Of::kDevice, a.endNs, b.beginNs,
            fmt::format("{:.2f} ms between {} and {}, with a barrier round each pass, as a capture has them.",
                        ms(b.beginNs - a.endNs), a.name, b.name)};
}

}  // namespace

std::vector<Gap> gapsOf(std::span<const Frame> frames, size_t index) {
    const Frame& f = frames[index];
    const Frame *before = frameBefore(frames, index, 1), *last = frameBefore(frames, index, 2);
    const uint64_t shortest = std::max(kShortestNs, lengthOf(f) / kShortestShare);
    std::vector<Gap> gaps;
    const auto longEnough = [&](uint64_t begin, uint64_t end) {
        return end > begin && end - begin >= shortest;
    };
    if (before && longEnough(before->cpu.submitted, f.cpu.begin)) gaps.push_back(betweenLoops(f, *before));
    if (longEnough(f.cpu.begin, f.cpu.waited)) gaps.push_back(waitOfLoop(f, last));
    if (before && !before->gpu.empty() && !f.gpu.empty() &&
        longEnough(before->gpu.back().endNs, f.gpu.front().beginNs))
        gaps.push_back(beforeFirstPass(f, *before));
    for (size_t i = 0; i + 1 < f.gpu.size(); ++i)
        if (longEnough(f.gpu[i].endNs, f.gpu[i + 1].beginNs))
            gaps.push_back(betweenPasses(f.gpu[i], f.gpu[i + 1]));
    std::ranges::stable_sort(gaps, {}, &Gap::beginNs);
    return gaps;
}

}  // namespace ag::capture
