// A line on stderr, at most twice a second: what is being done, the share of it that is, and the time left.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace ag::workbench {

class ProgressLine {
  public:
    explicit ProgressLine(std::string what = "") : what_(std::move(what)) {}
    ~ProgressLine();
    void operator()(double share);

  private:
    using Clock = std::chrono::steady_clock;
    std::string what_;
    std::mutex mutex_;
    Clock::time_point start_ = Clock::now(), last_ = start_;
    bool shown_ = false;
};

}  // namespace ag::workbench
