#include "engine/renderer/frame_budget.h"

#include <algorithm>
#include <cmath>

namespace ag::render {
namespace {

struct Row {
    std::string_view name;
    float scale;
    uint32_t mapResolution, valCount, ismTile, pointsPerMap, spacing;
    float nearReach;
    uint32_t taps;
    double relativeCost;
};
constexpr std::array kRows = {Row{"half", 0.5f, 64, 48, 32, 768, 3, 2, 4, 0.2},
                              Row{"three quarters", 0.75f, 64, 48, 32, 768, 3, 2, 4, 0.28},
                              Row{"below low", 1, 64, 48, 32, 768, 3, 2, 4, 0.4},
                              Row{"low", 1, 256, 64, 32, 1024, 3, 2, 4, 0.5},
                              Row{"low 80", 1, 256, 80, 32, 1536, 3, 2, 4, 0.56},
                              Row{"low 112", 1, 256, 112, 32, 2048, 3, 2, 4, 0.64},
                              Row{"low 112, 2 x 2", 1, 256, 112, 32, 1536, 2, 2, 4, 0.72},
                              Row{"medium 112, maps of 256²", 1, 256, 112, 48, 1536, 2, 2, 4, 0.84},
                              Row{"medium 128, maps of 256²", 1, 256, 128, 48, 1536, 2, 2, 4, 0.88},
                              Row{"medium 144, maps of 256²", 1, 256, 144, 48, 1536, 2, 2, 4, 0.91},
                              Row{"medium 160, maps of 256²", 1, 256, 160, 48, 1536, 2, 2, 4, 0.94},
                              Row{"medium 112", 1, 0, 112, 48, 1536, 2, 2, 4, 0.96},
                              Row{"medium", 1, 0, 128, 48, 1536, 2, 2, 4, 1},
                              Row{"medium 144", 1, 0, 144, 48, 1536, 2, 2, 4, 1.08},
                              Row{"medium 160", 1, 0, 160, 48, 1536, 2, 2, 4, 1.15},
                              Row{"medium 176", 1, 0, 176, 48, 2048, 2, 2, 4, 1.24},
                              Row{"medium 200", 1, 0, 200, 48, 2560, 2, 2, 4, 1.46},
                              Row{"medium 224", 1, 0, 224, 48, 3072, 2, 2, 4, 1.6},
                              Row{"high 208", 1, 512, 208, 64, 3072, 2, 2, 4, 1.85},
                              Row{"high", 1, 512, 256, 64, 4096, 2, 2, 4, 2.05},
                              Row{"high 320", 1, 512, 320, 64, 4096, 2, 2, 4, 2.4},
                              Row{"high 384", 1, 512, 384, 64, 4096, 2, 3, 4, 2.9},
                              Row{"high 384, 8 taps", 1, 512, 384, 64, 6144, 2, 3, 8, 3.3},
                              Row{"ultra, 8 taps", 1, 512, 512, 64, 6144, 2, 4, 8, 4.3},
                              Row{"ultra 416, 8 taps", 1, 512, 416, 96, 5120, 2, 4, 8, 5.2},
                              Row{"ultra 384, 8 taps", 1, 512, 384, 128, 4096, 2, 4, 8, 6},
                              Row{"ultra 448, 8 taps", 1, 512, 448, 128, 5120, 2, 4, 8, 7.4},
                              Row{"ultra, 12 taps", 1, 1024, 512, 128, 6144, 2, 4, 12, 9.1},
                              Row{"ultra", 1, 1024, 512, 128, 8192, 2, 6, 16, 9.9}};

// Relative RMSE of the first bounce beside "medium" (docs/skipping.md).
struct MeasuredError {
    std::string_view step;
    double relative;
};
constexpr std::array kErrors = {MeasuredError{"below low", 2.54},
                                MeasuredError{"low", 1.88},
                                MeasuredError{"low 112", 1.80},
                                MeasuredError{"low 112, 2 x 2", 1.09},
                                MeasuredError{"medium 128, maps of 256²", 1.02},
                                MeasuredError{"medium", 1},
                                MeasuredError{"medium 176", 0.99},
                                MeasuredError{"medium 224", 0.93},
                                MeasuredError{"high", 0.96},
                                MeasuredError{"high 384", 0.94},
                                MeasuredError{"ultra, 8 taps", 0.89},
                                MeasuredError{"ultra 448, 8 taps", 0.88},
                                MeasuredError{"ultra", 0.91}};

double errorOf(std::string_view step) {
    const auto found = std::ranges::find(kErrors, step, &MeasuredError::step);
    return found == kErrors.end() ? 0 : found->relative;
}

// Of the budget: what a frame may take before a faster step is chosen, what a step may be expected to take if
// it was never seen and if it was. Between the first and the last nothing changes.
constexpr double kTooLong = 1.08, kNewStep = 1.02, kKnownStep = 0.98;
constexpr uint32_t kWarmFrames = 4;  // after a change: times are still of the step before
constexpr uint32_t kFewFrames = 3;   // seen at a step before it is judged too slow
constexpr uint32_t kPatience = 12;   // frames before going up

QualityStep stepOf(const Row& row) {
    return {std::string(row.name), row.scale,   row.mapResolution, row.valCount, row.ismTile,
            row.pointsPerMap,      row.spacing, row.nearReach,     row.taps,     row.relativeCost,
            errorOf(row.name)};
}

// Half way to the next row in what can be had in small amounts: steps are fine enough for any budget.
QualityStep between(const Row& row, const Row& next) {
    const auto middle = [](uint32_t a, uint32_t b) {
        return uint32_t(std::lround(std::sqrt(double(a) * b)));
    };
    QualityStep step = stepOf(row);
    step.name += " +";
    step.relativeError = 0;
    step.scale = std::sqrt(row.scale * next.scale);
    step.valCount = middle(row.valCount, next.valCount);
    step.pointsPerMap = middle(row.pointsPerMap, next.pointsPerMap);
    step.relativeCost = std::sqrt(row.relativeCost * next.relativeCost);
    return step;
}

std::vector<QualityStep> makeSteps() {
    std::vector<QualityStep> steps;
    for (size_t i = 0; i < kRows.size(); ++i) {
        steps.push_back(stepOf(kRows[i]));
        // RSMs have no size half way.
        if (i + 1 < kRows.size() && kRows[i].mapResolution == kRows[i + 1].mapResolution)
            steps.push_back(between(kRows[i], kRows[i + 1]));
    }
    return steps;
}

// What a third of the times is below: where something else has the device for some frames most are too long,
// and where there is more to do all are.
double lowerThirdOf(std::span<const double> values) {
    std::array<double, 9> sorted{};
    const auto end = std::copy(values.begin(), values.end(), sorted.begin());
    const auto third = sorted.begin() + std::ptrdiff_t((values.size() - 1) / 3);
    std::nth_element(sorted.begin(), third, end);
    return *third;
}

}  // namespace

std::span<const QualityStep> qualitySteps() {
    static const std::vector<QualityStep> steps = makeSteps();
    return steps;
}

size_t firstFullSizeStep() {
    return size_t(std::ranges::find(qualitySteps(), 1.0f, &QualityStep::scale) - qualitySteps().begin());
}

size_t qualityStepNamed(std::string_view name) {
    return size_t(std::ranges::find(qualitySteps(), name, &QualityStep::name) - qualitySteps().begin());
}

void applyQualityStep(const QualityStep& step, RenderSettings& s) {
    s.bounce.rsm.resolution = step.mapResolution;
    s.bounce.valClustering.count = step.valCount;
    s.bounce.ismAtlas.tileSize = step.ismTile;
    s.bounce.ismAtlas.pointsPerMap = step.pointsPerMap;
    s.bounce.spacing = step.spacing;
    s.bounce.valShading.nearReach = step.nearReach;
    s.bounce.valShading.taps = step.taps;
}

double FrameCost::add(std::span<const PassReport> passes, bool partly) {
    double sum = 0;
    for (const PassReport& pass : passes) {
        if (pass.outcome == PassOutcome::kRan && pass.gpuMs > 0 && !(partly && known_.contains(pass.name)))
            known_[pass.name] = pass.gpuMs;
        if (pass.outcome == PassOutcome::kDropped) continue;
        const auto found = known_.find(pass.name);
        if (found != known_.end()) sum += found->second;
    }
    return sum;
}

BudgetController::BudgetController(double budgetMs, size_t lowest)
    : budgetMs_(budgetMs),
      lowest_(lowest),
      step_(lowest),
      costs_(qualitySteps().size(), 0),
      measured_(qualitySteps().size(), false) {}

// A step not yet seen: by its guess beside that of the nearest one that was.
double BudgetController::expected(size_t step) const {
    if (measured_[step]) return costs_[step];
    size_t nearest = step_;
    for (size_t i = 0; i < costs_.size(); ++i)
        if (measured_[i] &&
            (!measured_[nearest] || std::abs(int(i) - int(step)) < std::abs(int(nearest) - int(step))))
            nearest = i;
    return costs_[nearest] * qualitySteps()[step].relativeCost / qualitySteps()[nearest].relativeCost;
}

size_t BudgetController::bestWithin(double newMs, double knownMs) const {
    for (size_t step = costs_.size() - 1; step > lowest_; --step)
        if (expected(step) <= (measured_[step] ? knownMs : newMs)) return step;
    return lowest_;
}

// The scene may have changed since other steps were seen: their times change with this one's.
void BudgetController::learn(double ms) {
    if (measured_[step_])
        for (size_t i = 0; i < costs_.size(); ++i)
            if (measured_[i] && i != step_) costs_[i] *= ms / costs_[step_];
    costs_[step_] = ms;
    measured_[step_] = true;
}

bool BudgetController::moveTo(size_t step) {
    const bool moves = step != step_;
    step_ = step;
    seen_ = promising_ = 0;
    return moves;
}

bool BudgetController::frame(double costMs) {
    if (costMs <= 0 || ++seen_ <= kWarmFrames) return false;
    const uint32_t count = seen_ - kWarmFrames;
    recent_[(count - 1) % recent_.size()] = costMs;
    if (count < kFewFrames) return false;
    learn(lowerThirdOf(std::span(recent_).first(std::min<size_t>(count, recent_.size()))));
    if (costs_[step_] > kTooLong * budgetMs_)
        return moveTo(std::min(bestWithin(kNewStep * budgetMs_, kNewStep * budgetMs_), step_));
    const size_t better = best();
    promising_ = better > step_ ? promising_ + 1 : 0;
    return promising_ >= kPatience && moveTo(better);
}

size_t BudgetController::best() const {
    return bestWithin(kNewStep * budgetMs_, kKnownStep * budgetMs_);
}

bool BudgetController::chooseAtOnce() {
    return hasMeasured() && moveTo(best());
}

}  // namespace ag::render
