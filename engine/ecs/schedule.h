// Systems in program order, and the graph that follows from what they touch.
//
// Of two systems that conflict, the one added first runs first; others may overlap. The graph is data: tests
// ask it by name, tools draw it. One thread is simply the list in order, and gives the same world.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "engine/ecs/commands.h"
#include "engine/ecs/view.h"
#include "engine/jobs/job_graph.h"

namespace ag {

struct SystemSpan {                   // of the last run
    uint64_t beginNs = 0, endNs = 0;  // steady clock
    uint64_t thread = 0;
};

namespace detail {

// How a system's parameter is made, and what it allows.
template <class P>
struct Param {
    static void access(Access& a) { P::access(a); }
    static P make(World& world, SystemTime time, Commands&, JobRunner&) { return P(world, time); }
};
template <>
struct Param<World&> {
    static void access(Access& a) { a.exclusive = true; }
    static World& make(World& world, SystemTime, Commands&, JobRunner&) { return world; }
};
template <>
struct Param<Commands&> {
    static void access(Access&) {}
    static Commands& make(World&, SystemTime, Commands& commands, JobRunner&) { return commands; }
};
template <>
struct Param<JobRunner&> {
    static void access(Access&) {}
    static JobRunner& make(World&, SystemTime, Commands&, JobRunner& runner) { return runner; }
};

template <class F>
struct Signature : Signature<decltype(&F::operator())> {};
template <class... Ps>
struct Signature<void (*)(Ps...)> {
    static Access access() {
        Access a;
        (Param<Ps>::access(a), ...);
        return a;
    }
    template <class F>
    static void call(F& f, World& world, SystemTime time, Commands& commands, JobRunner& runner) {
        f(Param<Ps>::make(world, time, commands, runner)...);
    }
};
template <class C, class... Ps>
struct Signature<void (C::*)(Ps...) const> : Signature<void (*)(Ps...)> {};

}  // namespace detail

class Schedule {
  public:
    // A free function or a lambda; its parameters are View, Lookup, Res, Commands&, JobRunner& and World&.
    template <class F>
    void add(std::string name, F system) {
        using S = detail::Signature<F>;
        insert(std::move(name), S::access(),
               [system](World& world, SystemTime time, Commands& commands, JobRunner& runner) mutable {
                   S::call(system, world, time, commands, runner);
               });
    }
    // Here the commands of the systems before are played; runs alone.
    void flush();

    // One frame: every system once, commands left over at the end.
    void run(World& world, JobRunner& runner);

    const JobGraph& graph();
    // Whether `before` is ordered before `after`, directly or over others.
    bool ordered(std::string_view before, std::string_view after);
    bool hasEdge(std::string_view before, std::string_view after);
    std::span<const SystemSpan> spans() const { return spans_; }  // parallel to the graph's nodes
    const std::string& name(size_t node) const { return systems_[node].name; }

  private:
    using Run = std::function<void(World&, SystemTime, Commands&, JobRunner&)>;
    struct System {
        std::string name;
        Access access;
        Run run;
        bool isFlush = false;
        uint32_t lastRun = 0;
        Commands commands;
        LoopCost cost;
    };
    void insert(std::string name, Access access, Run run);
    void build();
    uint32_t find(std::string_view name) const;
    void playCommands(World& world, size_t end);

    std::vector<System> systems_;
    std::vector<SystemSpan> spans_;
    JobGraph graph_;
    bool stale_ = true;
};

}  // namespace ag
