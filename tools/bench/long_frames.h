// Which step made a long frame long: each step of each frame beside its own median.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/frame/frame_graph.h"
#include "tools/bench/drive.h"

namespace ag::bench {

class LongFrames {
  public:
    // Of the next frame: what the CPU took, then its graph, just executed. Times of passes arrive late and
    // are put to the frame they are of.
    void note(const FrameCost& cost);
    void note(const FrameGraph& graph);
    // Fills in what the device took and names the ten longest frames of report.frames. The last frames'
    // passes have no times yet.
    void finish(DriveReport& report) const;

  private:
    struct Step {
        double ms = 0;
        std::string why;
    };
    using Steps = std::map<std::string, Step, std::less<>>;
    std::vector<Culprit> culpritsOf(const Steps& steps) const;
    double medianOf(const std::string& step) const;

    std::vector<Steps> frames_;
    std::map<uint64_t, size_t> frameOf_;  // by the graph's number
};

Spread spreadOf(std::vector<double> values);

}  // namespace ag::bench
