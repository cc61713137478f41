// What the frames of the last seconds cost on the device, technique by technique, and those that stood out.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "engine/frame/frame_graph.h"

namespace ag {

struct FrameCost {
    uint64_t frame = 0;
    double ms = 0;                  // of all passes
    std::vector<float> techniques;  // ms, by PassHistory::techniques()
    std::string worst;              // the pass that took longest
    double worstMs = 0;
};

class PassHistory {
  public:
    static constexpr size_t kFrames = 240;
    static constexpr size_t kSpikes = 6;        // kept; a longer one pushes out the shortest
    static constexpr double kSpikeRatio = 1.5;  // times the median of the frames before

    // The frame whose times arrived last; one seen before counts once.
    void add(const FrameSpans& spans, double budgetMs);
    void forgetSpikes() { spikes_.clear(); }

    const std::vector<std::string>& techniques() const { return techniques_; }  // what stands before the dot
    const std::deque<FrameCost>& frames() const { return frames_; }             // oldest first
    // Frames over the budget and far over what was usual then, longest first, until they are forgotten.
    const std::vector<FrameCost>& spikes() const { return spikes_; }
    double medianMs() const;
    double medianMs(size_t technique) const;

  private:
    size_t techniqueOf(std::string_view pass);
    void keepSpike(const FrameCost& frame);

    std::vector<std::string> techniques_;
    std::deque<FrameCost> frames_;
    std::vector<FrameCost> spikes_;
};

}  // namespace ag
