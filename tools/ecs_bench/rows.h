// A row of the bench: a loop of ours, most often beside the same loop over plain arrays, and what it must
// hold.
#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <string>
#include <vector>

namespace ag::ecs_bench {

using Bench = std::function<void(benchmark::State&)>;

enum class Target { kRatio, kNs, kNone };  // of ours to the other; of ours alone; only shown

struct Row {
    std::string name;
    std::string ours, other;  // names of benchmarks; other may be empty
    Target kind = Target::kRatio;
    double atMost = 0;
};

class Rows {
  public:
    // Registers `name`/ours and `name`/plain.
    void compare(const std::string& name, double atMost, Bench ours, Bench plain);
    // Only ours, in ns an item. `seconds` a repetition, if two threads need long to meet two idle cores.
    void alone(const std::string& name, double atMostNs, Bench ours, double seconds = 0);
    // Ours against another benchmark, registered by another row.
    void against(const std::string& name, double atMost, Bench ours, const std::string& other,
                 double seconds = 0);
    // Two benchmarks registered by other rows.
    void against(const std::string& name, double atMost, const std::string& ours, const std::string& other);
    const std::vector<Row>& all() const { return rows_; }

  private:
    std::vector<Row> rows_;
};

void addIterationRows(Rows& rows);
void addArchetypeRows(Rows& rows);
void addStructureRows(Rows& rows);
void addFrameRows(Rows& rows);
void addUploadRows(Rows& rows);
void addScheduleRows(Rows& rows);
void addCrowdRows(Rows& rows);

enum class Clock { kThread, kWall };  // CPU time of the one thread; two threads are timed on the wall
double secondsNow(Clock clock);

// What a repetition's iterations cost. The wall clock can only be late, so its least counts. A thread's CPU
// clock on a busy virtual machine is at times set back by what the host took, so its lower quartile counts.
double typicalBest(std::vector<double>& seconds, Clock clock);

// Times `body` after an untimed `prepare`, every iteration; the counter "best" is in ns an item.
template <class Prepare, class Body>
void timed(benchmark::State& state, double items, Prepare prepare, Body body, Clock clock = Clock::kThread) {
    std::vector<double> all;
    for ([[maybe_unused]] auto turn : state) {
        prepare();
        const double begin = secondsNow(clock);
        body();
        all.push_back(std::max(secondsNow(clock) - begin, 1e-9));
        state.SetIterationTime(all.back());
    }
    state.counters["best"] = typicalBest(all, clock) * 1e9 / items;
}
template <class Body>
void timed(benchmark::State& state, double items, Body body, Clock clock = Clock::kThread) {
    timed(
        state, items, [] {}, body, clock);
}

}  // namespace ag::ecs_bench
