#include "tools/workbench/progress_line.h"

#include <fmt/format.h>

#include <iostream>

namespace ag::workbench {

ProgressLine::~ProgressLine() {
    if (shown_) std::cerr << '\n';
}

void ProgressLine::operator()(double share) {
    const std::lock_guard lock(mutex_);
    const auto now = Clock::now();
    if (now - last_ < std::chrono::milliseconds(500)) return;
    last_ = now;
    const double spent = std::chrono::duration<double>(now - start_).count();
    std::cerr << fmt::format("\r{}{:3.0f} %, {:.0f} s left   ", what_, share * 100,
                             share > 0 ? spent / share * (1 - share) : 0);
    shown_ = true;
}

}  // namespace ag::workbench
