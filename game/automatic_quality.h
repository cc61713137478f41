// The quality that fits a time for a frame's passes, chosen from the program's first second on.
#pragma once

#include <chrono>

#include "engine/renderer/frame_budget.h"
#include "engine/renderer/renderer.h"

namespace ag::game {

class AutomaticQuality {
  public:
    explicit AutomaticQuality(double budgetMs) : budget_(budgetMs, 0) {}  // starts at the fastest

    const render::QualityStep& step() const { return render::qualitySteps()[budget_.step()]; }
    // While it finds out what the device can do, nothing may be skipped.
    bool isMeasuring() const { return isMeasuring_; }
    // After each frame; `counts`: it was one of the game that is played. True: another step was chosen.
    bool frame(render::Renderer& renderer, bool counts);
    void endMeasuring() { isMeasuring_ = false; }

  private:
    using Clock = std::chrono::steady_clock;

    render::BudgetController budget_;
    render::FrameCost cost_;
    Clock::time_point start_ = Clock::now();
    bool isMeasuring_ = true;
};

}  // namespace ag::game
