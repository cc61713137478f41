#include "engine/ecs/schedule.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace ag {
namespace {

uint64_t nowNs() {
    return uint64_t(std::chrono::duration_cast<std::chrono::nanoseconds>(
                        std::chrono::steady_clock::now().time_since_epoch())
                        .count());
}

}  // namespace

void Schedule::insert(std::string name, Access access, Run run) {
    for (const System& known : systems_)
        AG_CHECK_MSG(known.name != name, "two systems are named " + name);
    for (const System& known : systems_)
        AG_CHECK_MSG(!known.access.takes.intersects(access.takes),
                     known.name + " and " + name + " both take the marks of a component");
    AG_CHECK_LT(systems_.size() + 1, size_t(kEndOfFrame));
    systems_.push_back({.name = std::move(name), .access = access, .run = std::move(run)});
    stale_ = true;
}

void Schedule::flush() {
    insert("flush " + std::to_string(systems_.size()), {.exclusive = true}, {});
    systems_.back().isFlush = true;
}

// An edge to each later system in conflict, unless a path leads there already.
void Schedule::build() {
    graph_ = {};
    for (const System& system : systems_)
        graph_.add(system.name);
    std::vector<std::vector<bool>> before(systems_.size(), std::vector<bool>(systems_.size(), false));
    for (uint32_t after = 0; after < systems_.size(); ++after) {
        for (uint32_t b = after; b-- > 0;) {
            if (before[after][b] || !systems_[b].access.conflicts(systems_[after].access)) continue;
            graph_.edge(b, after);
            before[after][b] = true;
            for (uint32_t i = 0; i < b; ++i)
                if (before[b][i]) before[after][i] = true;
        }
    }
    spans_.assign(systems_.size(), {});
    stale_ = false;
}

const JobGraph& Schedule::graph() {
    if (stale_) build();
    return graph_;
}

uint32_t Schedule::find(std::string_view name) const {
    const auto found = std::ranges::find(systems_, name, &System::name);
    AG_CHECK_MSG(found != systems_.end(), "no system is named " + std::string(name));
    return uint32_t(found - systems_.begin());
}

bool Schedule::ordered(std::string_view before, std::string_view after) {
    const uint32_t b = find(before), a = find(after);
    return b < a && graph().reaches(b, a);
}

bool Schedule::hasEdge(std::string_view before, std::string_view after) {
    return std::ranges::count(graph().nodes[find(before)].next, find(after)) > 0;
}

void Schedule::playCommands(World& world, size_t end) {
    for (size_t i = 0; i < end; ++i)
        systems_[i].commands.play(world);
}

void Schedule::run(World& world, JobRunner& runner) {
    graph();
    const uint32_t base = world.frame() * kVersionsPerFrame;
    runner.run(graph_, [&](uint32_t index) {
        System& system = systems_[index];
        SystemSpan& span = spans_[index];
        span.beginNs = nowNs();
        span.thread = std::hash<std::thread::id>{}(std::this_thread::get_id());
        const SystemTime time{.version = base + index + 1, .lastRun = system.lastRun, .cost = &system.cost};
        if (system.access.exclusive) world.setPosition(index + 1);
        if (system.isFlush)
            playCommands(world, index);
        else
            system.run(world, time, system.commands, runner);
        if (system.access.exclusive) world.setPosition(0);
        system.lastRun = time.version;
        span.endNs = nowNs();
    });
    world.setPosition(kEndOfFrame);
    playCommands(world, systems_.size());
    world.setPosition(0);
    world.advanceFrame();
}

}  // namespace ag
