// Loops over one to seven components, in a fresh world and in an aged one, and over components few have.
#include <algorithm>
#include <random>

#include "engine/ecs/view.h"
#include "tools/ecs_bench/kernels.h"
#include "tools/ecs_bench/plain_table.h"
#include "tools/ecs_bench/rows.h"

namespace ag::ecs_bench {
namespace {

constexpr SystemTime kNow{.version = 1 << 20};

using PlainThree = PlainTable<Position, Velocity, Acceleration>;
using PlainSeven = PlainTable<Position, Velocity, Acceleration, Rotation, Spin, Life, Warmth>;

struct Ours {
    World world;
    std::vector<Entity> entities;
};
struct Plain {
    HandleTable handles;
    PlainThree three{handles, 0};
    PlainSeven seven{handles, 1};
    std::vector<uint32_t> chosen;
};

void fill(Ours& w, uint32_t count, bool seven) {
    for (uint32_t i = 0; i < count; ++i)
        w.entities.push_back(seven ? w.world.create(positionOf(i), velocityOf(i), accelerationOf(i),
                                                    Rotation{}, Spin{{1, 2, 3}}, Life{1}, Warmth{300})
                                   : w.world.create(positionOf(i), velocityOf(i), accelerationOf(i)));
}
void fill(Plain& w, uint32_t count, bool seven) {
    for (uint32_t i = 0; i < count; ++i) {
        if (seven)
            w.seven.create(positionOf(i), velocityOf(i), accelerationOf(i), Rotation{}, Spin{{1, 2, 3}},
                           Life{1}, Warmth{300});
        else
            w.three.create(positionOf(i), velocityOf(i), accelerationOf(i));
    }
}

// Both live as long as the program: filled once, whatever the number of repetitions.
template <class W>
W& filled(uint32_t count, bool seven) {
    static std::vector<std::tuple<uint32_t, bool, std::unique_ptr<W>>> worlds;
    for (auto& [n, s, world] : worlds)
        if (n == count && s == seven) return *world;
    auto fresh = std::make_unique<W>();
    fill(*fresh, count, seven);
    return *std::get<2>(worlds.emplace_back(count, seven, std::move(fresh)));
}

template <class ViewType, class F>
Bench oursLoop(uint32_t count, bool seven, F f) {
    return [=](benchmark::State& state) {
        World& world = filled<Ours>(count, seven).world;
        timed(state, count, [&] { ViewType(world, kNow).each(f); });
    };
}
template <class F>
Bench plainLoop(uint32_t count, bool seven, F f) {
    return [=](benchmark::State& state) {
        Plain& world = filled<Plain>(count, seven);
        timed(state, count, [&] {
            if constexpr (std::is_invocable_v<F, PlainThree&>)
                f(world.three);
            else
                f(world.seven);
            benchmark::ClobberMemory();
        });
    };
}

void addLoops(Rows& rows, uint32_t count, const std::string& size, std::array<double, 4> atMost) {
    rows.compare("iterate 1, " + size, atMost[0],
                 oursLoop<View<Position>>(count, false, [](Position& p) { iterate1(p); }),
                 plainLoop(count, false, [](PlainThree& t) {
                     Position* p = t.column<Position>().data();
                     for (size_t i = 0, n = t.owners().size(); i < n; ++i)
                         iterate1(p[i]);
                 }));
    rows.compare("iterate 2, " + size, atMost[1],
                 oursLoop<View<Position, const Velocity>>(
                     count, false, [](Position& p, const Velocity& v) { iterate2(p, v); }),
                 plainLoop(count, false, [](PlainThree& t) {
                     Position* p = t.column<Position>().data();
                     const Velocity* v = t.column<Velocity>().data();
                     for (size_t i = 0, n = t.owners().size(); i < n; ++i)
                         iterate2(p[i], v[i]);
                 }));
    rows.compare(
        "iterate 3, " + size, atMost[2],
        oursLoop<View<Position, Velocity, const Acceleration>>(
            count, false, [](Position& p, Velocity& v, const Acceleration& a) { iterate3(p, v, a); }),
        plainLoop(count, false, [](PlainThree& t) { t.each(iterate3); }));
    rows.compare("iterate 7, " + size, atMost[3],
                 oursLoop<View<Position, Velocity, const Acceleration, Rotation, const Spin, Life, Warmth>>(
                     count, true,
                     [](Position& p, Velocity& v, const Acceleration& a, Rotation& r, const Spin& s, Life& l,
                        Warmth& k) { iterate7(p, v, a, r, s, l, k); }),
                 plainLoop(count, true, [](PlainSeven& t) { t.each(iterate7); }));
}

// Half of the entities destroyed and made again in random order; half had a component taken off and put back.
void age(Ours& w) {
    std::mt19937 random(7);
    std::ranges::shuffle(w.entities, random);
    const size_t half = w.entities.size() / 2;
    for (size_t i = 0; i < half; ++i)
        w.world.destroy(w.entities[i]);
    for (size_t i = 0; i < half; ++i)
        w.entities[i] = w.world.create(positionOf(uint32_t(i)), velocityOf(uint32_t(i)), accelerationOf(1));
    std::ranges::shuffle(w.entities, random);
    for (size_t i = 0; i < half; ++i)
        w.world.remove<Acceleration>(w.entities[i]);
    for (size_t i = 0; i < half; ++i)
        w.world.add(w.entities[i], accelerationOf(uint32_t(i)));
}
void age(Plain& w) {
    std::mt19937 random(7);
    std::vector<Entity> entities = w.three.owners();
    std::ranges::shuffle(entities, random);
    const size_t half = entities.size() / 2;
    for (size_t i = 0; i < half; ++i)
        w.three.destroy(entities[i]);
    for (size_t i = 0; i < half; ++i)
        w.three.create(positionOf(uint32_t(i)), velocityOf(uint32_t(i)), accelerationOf(1));
}
template <class W>
W& aged(uint32_t count) {
    static std::vector<std::pair<uint32_t, std::unique_ptr<W>>> worlds;
    for (auto& [n, world] : worlds)
        if (n == count) return *world;
    auto fresh = std::make_unique<W>();
    fill(*fresh, count, false);
    age(*fresh);
    return *worlds.emplace_back(count, std::move(fresh)).second;
}

void addAged(Rows& rows, uint32_t count, const std::string& size, double atMost) {
    rows.compare(
        "aged world, iterate 3, " + size, atMost,
        [=](benchmark::State& state) {
            World& world = aged<Ours>(count).world;
            timed(state, count, [&] {
                View<Position, Velocity, const Acceleration>(world, kNow)
                    .each([](Position& p, Velocity& v, const Acceleration& a) { iterate3(p, v, a); });
            });
        },
        [=](benchmark::State& state) {
            Plain& world = aged<Plain>(count);
            timed(state, count, [&] {
                world.three.each(iterate3);
                benchmark::ClobberMemory();
            });
        });
}

// Every `nth` entity has the component; arrays keep a list of who has it.
void addSparse(Rows& rows, uint32_t nth, const std::string& share) {
    constexpr uint32_t kCount = 100'000;
    const auto make = [nth] {
        auto w = std::make_shared<Ours>();
        fill(*w, kCount, false);
        for (uint32_t i = 0; i < kCount; i += nth)
            w->world.add(w->entities[i], Warmth{300});
        return w;
    };
    const auto makePlain = [nth] {
        auto w = std::make_shared<Plain>();
        fill(*w, kCount, false);
        for (uint32_t i = 0; i < kCount; i += nth)
            w->chosen.push_back(i);
        return w;
    };
    rows.compare(
        "sparse " + share + ", per match, 100k", 0.8,
        [=, w = std::shared_ptr<Ours>()](benchmark::State& state) mutable {
            if (!w) w = make();
            timed(state, double(kCount / nth), [&] {
                View<Position, const Velocity, With<Warmth>>(w->world, kNow)
                    .each([](Position& p, const Velocity& v) { iterate2(p, v); });
            });
        },
        [=, w = std::shared_ptr<Plain>()](benchmark::State& state) mutable {
            if (!w) w = makePlain();
            timed(state, double(kCount / nth), [&] {
                Position* p = w->three.column<Position>().data();
                const Velocity* v = w->three.column<Velocity>().data();
                for (const uint32_t i : w->chosen)
                    iterate2(p[i], v[i]);
                benchmark::ClobberMemory();
            });
        });
}

}  // namespace

void addIterationRows(Rows& rows) {
    addLoops(rows, 100'000, "100k", {1.15, 1.15, 1.15, 1.15});
    addLoops(rows, 1'000'000, "1M", {1.5, 1.5, 1.4, 1.4});
    addAged(rows, 100'000, "100k", 1.3);
    addAged(rows, 1'000'000, "1M", 1.5);
    addSparse(rows, 10, "10 %");
    addSparse(rows, 2, "50 %");
}

}  // namespace ag::ecs_bench
