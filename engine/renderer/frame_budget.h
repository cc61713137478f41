// A time for each frame instead of a preset: settings along the front of time against error, from fastest to
// best, and the choice among them by what passes take. Pure functions of the times given: no clock, no
// device.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/frame/frame_graph.h"
#include "engine/renderer/render_settings.h"

namespace ag::render {

// A step of quality: our preset with these knobs.
struct QualityStep {
    std::string name;
    float scale = 1;             // of the picture's sides, rendered: AntialiasingSettings::scale
    uint32_t mapResolution = 0;  // texels along an RSM; 0: as each light says
    uint32_t valCount = 128;
    uint32_t ismTile = 64, pointsPerMap = 1536;
    uint32_t spacing = 2;  // pixels from one that is gathered to the next
    float nearReach = 2;
    uint32_t taps = 4;
    double relativeCost = 1;   // of a frame, beside "medium"; a first guess for each scene
    double relativeError = 0;  // RMSE of the first bounce, beside "medium"; 0: not measured
};
std::span<const QualityStep> qualitySteps();
size_t qualityStepNamed(std::string_view name);
size_t firstFullSizeStep();  // the ones before render a part of the pixels
// Only the knobs; all else stays. `scale` is the caller's.
void applyQualityStep(const QualityStep& step, RenderSettings& s);

// What a frame would take if nothing were skipped: of each pass it needs, the last time it took. So a scene
// that stands still does not look cheap.
class FrameCost {
  public:
    // ms; 0 as long as nothing was timed. `partly`: the times are of a frame in which passes did a part of
    // their work (Renderer::timesArePartial); what was known of those before stays.
    double add(std::span<const PassReport> passes, bool partly = false);
    void forget() { known_.clear(); }

  private:
    std::unordered_map<std::string_view, double> known_;
};

// Chooses the step that comes nearest to the budget without going far over it. Goes down at once when frames
// are too long, and up only when a better step has looked good enough for a while, so that quality does not
// pump; what it sees at each step replaces the guess of its cost.
class BudgetController {
  public:
    // Starts at the lowest step it may choose.
    BudgetController(double budgetMs, size_t lowest);

    // After each frame, with its cost in ms (0: not known). True if the step changed.
    bool frame(double costMs);
    // The best step by what frames so far took, without waiting whether it stays so: a program's start.
    // Nothing and false before enough of them.
    bool chooseAtOnce();
    bool hasMeasured() const { return measured_[step_]; }
    size_t step() const { return step_; }
    double budgetMs() const { return budgetMs_; }

  private:
    double expected(size_t step) const;
    size_t bestWithin(double newMs, double knownMs) const;
    size_t best() const;
    void learn(double ms);
    bool moveTo(size_t step);

    double budgetMs_;
    size_t lowest_, step_;
    std::vector<double> costs_;  // ms, by step: measured, or guessed from those measured
    std::vector<bool> measured_;
    std::array<double, 9> recent_{};  // ms
    uint32_t seen_ = 0;               // frames at this step
    uint32_t promising_ = 0;          // frames for which a better step has looked good
};

}  // namespace ag::render
