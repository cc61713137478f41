// Quantiles of any number of times in a fixed amount of memory, to one percent.
#pragma once

#include <cstdint>
#include <vector>

namespace ag::game {

class TimeHistogram {
  public:
    void add(double ms);  // above 0; else it is not counted
    void clear() { *this = {}; }
    uint64_t count() const { return count_; }
    // 0 as long as nothing was added.
    double quantile(double q) const;

  private:
    std::vector<uint32_t> bins_;  // by the logarithm; none before the first time
    uint64_t count_ = 0;
};

}  // namespace ag::game
