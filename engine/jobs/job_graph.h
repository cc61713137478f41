// A graph of jobs as data, and the workers that run it. A job starts when all it waits for is done; the
// worker that finishes the last of these goes on with it itself, so a chain never changes cores.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/function_ref.h"

namespace ag {

struct JobGraph {
    struct Node {
        std::string name;
        std::vector<uint32_t> next;  // jobs that wait for this one, ascending
        uint32_t waitsFor = 0;
    };
    std::vector<Node> nodes;

    uint32_t add(std::string name);
    void edge(uint32_t before, uint32_t after);  // before < after: program order is the meaning
    bool reaches(uint32_t before, uint32_t after) const;
    std::string graphviz() const;
};

// Runs graphs and loops: on oneTBB, or with AFTERGLOW_JOBS_STD_THREAD on a few std::threads (for the thread
// sanitizer, which cannot see into TBB). With one thread everything runs in order on the caller.
class JobRunner {
  public:
    explicit JobRunner(uint32_t threads = 0);  // 0: as many as the machine has
    ~JobRunner();
    JobRunner(const JobRunner&) = delete;
    JobRunner& operator=(const JobRunner&) = delete;

    uint32_t threadCount() const { return threads_; }
    // Calls run(node) for every node, as the edges allow; returns when all are done.
    void run(const JobGraph& graph, FunctionRef<void(uint32_t)> run);
    // Calls body(begin, end) over [0, count) in pieces of `grain`; the pieces are the same for any thread
    // count.
    void parallelFor(uint32_t count, uint32_t grain, FunctionRef<void(uint32_t, uint32_t)> body);

  private:
    struct Impl;
    uint32_t threads_;
    std::unique_ptr<Impl> impl_;
};

}  // namespace ag
