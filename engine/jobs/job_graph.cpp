#include "engine/jobs/job_graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <thread>

#include "engine/core/check.h"

#ifdef AFTERGLOW_JOBS_STD_THREAD
#include "engine/jobs/thread_pool.h"
#else
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>
#endif

namespace ag {

uint32_t JobGraph::add(std::string name) {
    nodes.push_back({.name = std::move(name)});
    return uint32_t(nodes.size() - 1);
}

void JobGraph::edge(uint32_t before, uint32_t after) {
    AG_CHECK_LT(before, after);
    AG_CHECK_LT(after, nodes.size());
    nodes[before].next.push_back(after);
    ++nodes[after].waitsFor;
}

bool JobGraph::reaches(uint32_t before, uint32_t after) const {
    if (before == after) return true;
    return std::ranges::any_of(nodes[before].next,
                               [&](uint32_t n) { return n <= after && reaches(n, after); });
}

std::string JobGraph::graphviz() const {
    std::string out = "digraph jobs {\n  rankdir=LR;\n  node [shape=box, fontname=sans];\n";
    for (size_t i = 0; i < nodes.size(); ++i) {
        out += fmt::format("  n{} [label=\"{}\"];\n", i, nodes[i].name);
        for (uint32_t next : nodes[i].next)
            out += fmt::format("  n{} -> n{};\n", i, next);
    }
    return out + "}\n";
}

struct JobRunner::Impl {
    std::vector<std::atomic<uint32_t>> waiting;  // of the graph running now
#ifdef AFTERGLOW_JOBS_STD_THREAD
    explicit Impl(uint32_t threads) : pool(threads) {}
    ThreadPool pool;
    void spawn(std::function<void()> task) {
        pool.spawn(std::move(task));
    }
    void wait() {
        pool.wait();
    }
#else
    explicit Impl(uint32_t threads) : arena(int(threads)) {}
    tbb::task_arena arena;
    tbb::task_group group;
    template <class F>
    void spawn(F&& task) {
        group.run(std::forward<F>(task));
    }
    void wait() {
        group.wait();
    }
#endif
    void finish(const JobGraph& graph, uint32_t node, FunctionRef<void(uint32_t)> run);
};

// Runs a node and then, itself, the first of those it makes ready; others become tasks.
void JobRunner::Impl::finish(const JobGraph& graph, uint32_t node, FunctionRef<void(uint32_t)> run) {
    constexpr uint32_t kNone = ~0u;
    while (node != kNone) {
        run(node);
        uint32_t mine = kNone;
        for (uint32_t next : graph.nodes[node].next) {
            if (waiting[next].fetch_sub(1, std::memory_order_acq_rel) != 1) continue;
            if (mine == kNone)
                mine = next;
            else
                spawn([this, &graph, next, run] { finish(graph, next, run); });
        }
        node = mine;
    }
}

JobRunner::JobRunner(uint32_t threads)
    : threads_(threads ? threads : std::max(std::thread::hardware_concurrency(), 1u)),
      impl_(std::make_unique<Impl>(threads_)) {}
JobRunner::~JobRunner() = default;

void JobRunner::run(const JobGraph& graph, FunctionRef<void(uint32_t)> run) {
    const auto count = uint32_t(graph.nodes.size());
    if (threads_ == 1) {
        for (uint32_t i = 0; i < count; ++i)
            run(i);
        return;
    }
    if (impl_->waiting.size() < count) impl_->waiting = std::vector<std::atomic<uint32_t>>(count);
    for (uint32_t i = 0; i < count; ++i)
        impl_->waiting[i].store(graph.nodes[i].waitsFor, std::memory_order_relaxed);
    const auto start = [&] {
        for (uint32_t i = 0; i < count; ++i)
            if (graph.nodes[i].waitsFor == 0)
                impl_->spawn([this, &graph, i, run] { impl_->finish(graph, i, run); });
        impl_->wait();
    };
#ifdef AFTERGLOW_JOBS_STD_THREAD
    start();
#else
    impl_->arena.execute(start);
#endif
}

void JobRunner::parallelFor(uint32_t count, uint32_t grain, FunctionRef<void(uint32_t, uint32_t)> body) {
    grain = std::max(grain, 1u);
    const uint32_t pieces = (count + grain - 1) / grain;
    const auto piece = [&](uint32_t i) { body(i * grain, std::min(count, (i + 1) * grain)); };
    if (threads_ == 1 || pieces <= 1) {
        for (uint32_t i = 0; i < pieces; ++i)
            piece(i);
        return;
    }
#ifdef AFTERGLOW_JOBS_STD_THREAD
    impl_->pool.forEach(pieces, piece);
#else
    impl_->arena.execute([&] {
        tbb::parallel_for(
            0u, pieces, [&](uint32_t i) { piece(i); }, tbb::simple_partitioner{});
    });
#endif
}

}  // namespace ag
