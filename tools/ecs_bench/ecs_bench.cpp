#include "tools/ecs_bench/ecs_bench.h"

#include <fmt/format.h>

#include <iostream>
#include <map>
#include <thread>

#include "tools/ecs_bench/frame.h"
#include "tools/ecs_bench/rows.h"

namespace ag::ecs_bench {
namespace {

// Keeps the best of each benchmark's repetitions.
class BestReporter : public benchmark::ConsoleReporter {
  public:
    BestReporter() : ConsoleReporter(OO_Tabular) {}
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) {
            const auto counter = run.counters.find("best");
            if (run.run_type != Run::RT_Iteration || counter == run.counters.end()) continue;
            const auto [entry, added] =
                best_.try_emplace(run.run_name.function_name, double(counter->second));
            entry->second = std::min(entry->second, double(counter->second));
            const auto copied = run.counters.find("copied_to_written");
            if (copied != run.counters.end()) copied_ = std::max(copied_, double(copied->second));
        }
        ConsoleReporter::ReportRuns(runs);
    }
    // Negative: did not run.
    double best(const std::string& name) const {
        const auto found = best_.find(name);
        return found == best_.end() ? -1 : found->second;
    }
    double copied() const { return copied_; }
    bool empty() const { return best_.empty(); }

  private:
    std::map<std::string, double> best_;
    double copied_ = 0;
};

bool printLine(const std::string& name, double ours, double other, double value, double atMost,
               bool hasTarget) {
    const bool good = !hasTarget || value <= atMost;
    fmt::print("{:<50} {:>12.2f} {:>12} {:>8} {:>10} {:>5}\n", name, ours,
               other < 0 ? "" : fmt::format("{:.2f}", other),
               other < 0 ? "" : fmt::format("{:.3f}", ours / other),
               hasTarget ? fmt::format("{:g}{}", atMost, other < 0 ? " ns" : "") : "", good ? "good" : "NOT");
    return good;
}

bool printRow(const Row& row, const BestReporter& times) {
    const double ours = times.best(row.ours), other = row.other.empty() ? -1 : times.best(row.other);
    if (ours < 0 || (!row.other.empty() && other < 0)) return true;  // filtered out
    return printLine(row.name, ours, other, row.kind == Target::kRatio ? ours / other : ours, row.atMost,
                     row.kind != Target::kNone);
}

// One thread, two threads and plain arrays must end in the same bits.
bool printHashes() {
    constexpr int kFrames = 30;
    OurFrame one(1), two(1);
    PlainFrame plain;
    JobRunner oneThread(1), twoThreads(2);
    for (int i = 0; i < kFrames; ++i) {
        one.run(oneThread);
        two.run(twoThreads);
        plain.run();
    }
    const bool threads = one.stateHash() == two.stateHash(),
               arrays = one.objectsHash() == plain.objectsHash();
    fmt::print("state after {} frames: one thread and two {}, ours and plain arrays {}\n", kFrames,
               threads ? "equal" : "DIFFER", arrays ? "equal" : "DIFFER");
    return threads && arrays;
}

// Flags of ours unless given: enough repetitions, interleaved, to compare within one run.
std::vector<char*> withDefaults(int argc, char** argv) {
    static char interleave[] = "--benchmark_enable_random_interleaving=true",
                repeat[] = "--benchmark_repetitions=8", shortest[] = "--benchmark_min_time=0.05",
                aggregates[] = "--benchmark_report_aggregates_only=false";
    std::vector<char*> all = {argv[0], interleave, repeat, shortest, aggregates};
    all.insert(all.end(), argv + 1, argv + argc);
    return all;
}

}  // namespace

int run(int argc, char** argv) {
    std::vector<char*> arguments = withDefaults(argc, argv);
    int count = int(arguments.size());
    Rows rows;
    addIterationRows(rows);
    addArchetypeRows(rows);
    addStructureRows(rows);
    addFrameRows(rows);
    addUploadRows(rows);
    addScheduleRows(rows);
    addCrowdRows(rows);
    benchmark::Initialize(&count, arguments.data());
    if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
    BestReporter reporter;
    benchmark::RunSpecifiedBenchmarks(&reporter);
    if (reporter.empty()) return 0;  // only listed
    fmt::print("\n{:<50} {:>12} {:>12} {:>8} {:>10}\n", "best of all repetitions", "ours ns", "plain ns",
               "ratio", "at most");
    bool good = true;
    for (const Row& row : rows.all())
        good = printRow(row, reporter) && good;
    if (reporter.copied() > 0)
        good = printLine("rows copied to rows changed", reporter.copied(), 1, reporter.copied(), 1.1, true) &&
               good;
    good = printHashes() && good;
    return good ? 0 : 1;
}

}  // namespace ag::ecs_bench
