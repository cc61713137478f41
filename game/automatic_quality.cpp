#include "game/automatic_quality.h"

#include "engine/core/log.h"

namespace ag::game {
namespace {

// The longest is for devices that do not say how long passes take.
constexpr auto kMeasured = std::chrono::seconds(1), kLongest = std::chrono::seconds(5);

}  // namespace

bool AutomaticQuality::frame(render::Renderer& renderer, bool counts) {
    const double cost = cost_.add(renderer.graph().report(), renderer.timesArePartial());
    const auto sinceStart = Clock::now() - start_;
    isMeasuring_ = isMeasuring_ && sinceStart < kLongest;
    if (!counts && !isMeasuring_) return false;
    const bool moved = budget_.frame(cost);
    if (!isMeasuring_ || !budget_.hasMeasured() || sinceStart < kMeasured) return moved;
    isMeasuring_ = false;
    const std::string before = step().name;
    const bool chosen = budget_.chooseAtOnce();
    spdlog::info("quality '{}': at '{}' a frame's passes take {:.0f} ms, {:.0f} ms are wanted", step().name,
                 before, cost, budget_.budgetMs());
    return chosen || moved;
}

}  // namespace ag::game
