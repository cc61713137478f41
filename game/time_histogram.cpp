#include "game/time_histogram.h"

#include <algorithm>
#include <cmath>

namespace ag::game {
namespace {

constexpr double kLeast = 1e-4, kGrowth = 1.01;  // ms of the first bin, and from one to the next
constexpr uint32_t kBins = 2400;                 // up to 2.3 million ms

}  // namespace

void TimeHistogram::add(double ms) {
    if (!(ms > 0)) return;
    if (bins_.empty()) bins_.resize(kBins);
    const double bin = std::log(std::max(ms, kLeast) / kLeast) / std::log(kGrowth);
    ++bins_[size_t(std::min(bin, kBins - 1.0))];
    ++count_;
}

double TimeHistogram::quantile(double q) const {
    if (count_ == 0) return 0;
    uint64_t left = uint64_t(q * double(count_ - 1));
    uint32_t bin = 0;
    for (; bin + 1 < kBins && left >= bins_[bin]; ++bin)
        left -= bins_[bin];
    return kLeast * std::pow(kGrowth, bin + 0.5);
}

}  // namespace ag::game
