#include "tools/ecs_bench/rows.h"

#include <algorithm>
#include <ctime>

namespace ag::ecs_bench {
namespace {

void add(const std::string& name, const Bench& bench, double seconds = 0) {
    auto* added = benchmark::RegisterBenchmark(name.c_str(), bench)->UseManualTime();
    added->Unit(benchmark::kMicrosecond);
    if (seconds > 0) added->MinTime(seconds);
}

}  // namespace

void Rows::compare(const std::string& name, double atMost, Bench ours, Bench plain) {
    add(name + "/ours", ours);
    add(name + "/plain", plain);
    rows_.push_back({name, name + "/ours", name + "/plain", Target::kRatio, atMost});
}

void Rows::alone(const std::string& name, double atMostNs, Bench ours, double seconds) {
    add(name + "/ours", ours, seconds);
    rows_.push_back({name, name + "/ours", {}, atMostNs > 0 ? Target::kNs : Target::kNone, atMostNs});
}

void Rows::against(const std::string& name, double atMost, Bench ours, const std::string& other,
                   double seconds) {
    add(name + "/ours", ours, seconds);
    rows_.push_back({name, name + "/ours", other, Target::kRatio, atMost});
}

void Rows::against(const std::string& name, double atMost, const std::string& ours,
                   const std::string& other) {
    rows_.push_back({name, ours, other, Target::kRatio, atMost});
}

double typicalBest(std::vector<double>& seconds, Clock clock) {
    const auto at = seconds.begin() + (clock == Clock::kThread ? ptrdiff_t(seconds.size() / 4) : 0);
    std::nth_element(seconds.begin(), at, seconds.end());
    return *at;
}

double secondsNow(Clock clock) {
    timespec t;
    clock_gettime(clock == Clock::kThread ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &t);
    return double(t.tv_sec) + double(t.tv_nsec) * 1e-9;
}

}  // namespace ag::ecs_bench
