// What systems take as parameters. Their types say everything a system touches: const is read, the rest is
// written, and what is not named does not compile.
//
//   void flickerLamps(View<PointLight, const Flicker> lamps, Res<const FrameTime> time);
#pragma once

#include <tuple>

#include "engine/ecs/world.h"
#include "engine/jobs/job_graph.h"

namespace ag {

// Filters of a View. Changed<const T> also gives the column; its rows are those of chunks written since the
// system last ran.
template <class T>
struct With {};
template <class T>
struct Without {};
template <class T>
struct Changed {};

// What a system is allowed to touch, as sets: the schedule's edges come from these.
struct Access {
    ComponentMask reads, writes, resourceReads, resourceWrites;
    bool exclusive = false;  // takes the World itself

    bool conflicts(const Access& other) const {
        const auto clash = [](const ComponentMask& w, const ComponentMask& r, const ComponentMask& w2) {
            return w.intersects(r) || w.intersects(w2);
        };
        return exclusive || other.exclusive || clash(writes, other.reads, other.writes) ||
               other.writes.intersects(reads) ||
               clash(resourceWrites, other.resourceReads, other.resourceWrites) ||
               other.resourceWrites.intersects(resourceReads);
    }
};

// Where a system stands in time: what it stamps, and what it has seen.
struct SystemTime {
    uint32_t version = 0;  // stamped on what it writes
    uint32_t lastRun = 0;  // its version when it ran before
};

namespace detail {

template <class Term>
struct TermTraits {  // T or const T
    using Column = Term;
    static constexpr bool kHasColumn = true;
    static void filter(ComponentMask& with, ComponentMask&) {
        with.set(componentId<std::remove_const_t<Term>>());
    }
    static void access(Access& a) {
        (std::is_const_v<Term> ? a.reads : a.writes).set(componentId<std::remove_const_t<Term>>());
    }
    static bool unseen(const Archetype&, const Chunk&, uint32_t) { return true; }
};
template <class T>
struct TermTraits<With<T>> {
    using Column = void;
    static constexpr bool kHasColumn = false;
    static void filter(ComponentMask& with, ComponentMask&) { with.set(componentId<T>()); }
    static void access(Access&) {}
    static bool unseen(const Archetype&, const Chunk&, uint32_t) { return true; }
};
template <class T>
struct TermTraits<Without<T>> {
    using Column = void;
    static constexpr bool kHasColumn = false;
    static void filter(ComponentMask&, ComponentMask& without) { without.set(componentId<T>()); }
    static void access(Access&) {}
    static bool unseen(const Archetype&, const Chunk&, uint32_t) { return true; }
};
template <class T>
struct TermTraits<Changed<T>> {
    static_assert(std::is_const_v<T>, "Changed reads: Changed<const T>");
    using Column = T;
    static constexpr bool kHasColumn = true;
    static void filter(ComponentMask& with, ComponentMask&) {
        with.set(componentId<std::remove_const_t<T>>());
    }
    static void access(Access& a) { a.reads.set(componentId<std::remove_const_t<T>>()); }
    static bool unseen(const Archetype& a, const Chunk& c, uint32_t lastRun) {
        return newerThan(c.versions[size_t(a.column(componentId<std::remove_const_t<T>>()))], lastRun);
    }
};

template <class Term>
using ColumnPointer = std::conditional_t<TermTraits<Term>::kHasColumn,
                                         std::tuple<typename TermTraits<Term>::Column*>, std::tuple<>>;

}  // namespace detail

// The columns of one chunk: `get<T>()` is a span over its rows.
class ChunkRows {
  public:
    ChunkRows(Archetype& archetype, Chunk& chunk) : archetype_(&archetype), chunk_(&chunk) {}
    uint32_t size() const { return chunk_->rows; }
    std::span<const Entity> entities() const { return {chunk_->entities(), chunk_->rows}; }
    template <class T>
    std::span<T> get() const {
        const int column = archetype_->column(componentId<std::remove_const_t<T>>());
        AG_CHECK_MSG(column >= 0, "the chunk has no such column");
        return {reinterpret_cast<T*>(chunk_->column(uint32_t(column))), chunk_->rows};
    }

  private:
    Archetype* archetype_;
    Chunk* chunk_;
};

template <class... Terms>
class View {
  public:
    View(World& world, SystemTime time) : world_(&world), time_(time) {
        (detail::TermTraits<Terms>::filter(with_, without_), ...);
    }
    static void access(Access& a) { (detail::TermTraits<Terms>::access(a), ...); }

    // f(T&...) or f(Entity, T&...) for each row. If f returns a bool it says whether it changed the row: a
    // chunk then counts as written only if one of its rows was.
    template <class F>
    void each(F&& f) const {
        forChunks([&](Archetype& archetype, Chunk& chunk) { rows(archetype, chunk, f); });
    }
    // The same with the chunks shared out over the runner's threads; f must not touch other rows' data.
    template <class F>
    void parallel(JobRunner& runner, F&& f) const {
        std::vector<std::pair<Archetype*, Chunk*>>& list = scratch();
        list.clear();
        forChunks([&](Archetype& archetype, Chunk& chunk) { list.push_back({&archetype, &chunk}); });
        runner.parallelFor(uint32_t(list.size()), 1, [&](uint32_t begin, uint32_t end) {
            for (uint32_t i = begin; i < end; ++i)
                rows(*list[i].first, *list[i].second, f);
        });
    }
    // f(ChunkRows) for each chunk; written columns count as written.
    template <class F>
    void chunks(F&& f) const {
        forChunks([&](Archetype& archetype, Chunk& chunk) {
            (stamp<Terms>(archetype, chunk), ...);
            markAll(archetype, chunk);
            f(ChunkRows(archetype, chunk));
        });
    }
    uint32_t count() const {
        uint32_t rows = 0;
        forChunks([&](Archetype&, Chunk& chunk) { rows += chunk.rows; });
        return rows;
    }

  private:
    template <class F>
    void forChunks(F&& f) const {
        for (Archetype& archetype : world_->archetypes()) {
            if (!archetype.mask.containsAll(with_) || archetype.mask.intersects(without_)) continue;
            for (const auto& chunk : archetype.chunks)
                if ((detail::TermTraits<Terms>::unseen(archetype, *chunk, time_.lastRun) && ...))
                    f(archetype, *chunk);
        }
    }
    template <class Term>
    static auto columnOf(Archetype& archetype, Chunk& chunk) {
        if constexpr (detail::TermTraits<Term>::kHasColumn) {
            using Column = typename detail::TermTraits<Term>::Column;
            const int column = archetype.column(componentId<std::remove_const_t<Column>>());
            return std::tuple<Column*>(reinterpret_cast<Column*>(chunk.column(uint32_t(column))));
        } else {
            return std::tuple<>();
        }
    }
    template <class F>
    void rows(Archetype& archetype, Chunk& chunk, F& f) const {
        const auto columns = std::tuple_cat(columnOf<Terms>(archetype, chunk)...);
        std::apply(
            [&](auto*... column) {
                const Entity* entities = chunk.entities();
                const auto call = [&](uint32_t row) {
                    if constexpr (std::is_invocable_v<F&, Entity, decltype(*column)...>)
                        return f(entities[row], column[row]...);
                    else
                        return f(column[row]...);
                };
                using Returned = decltype(call(0));
                bool written = false;
                for (uint32_t row = 0; row < chunk.rows; ++row) {
                    if constexpr (std::is_same_v<Returned, bool>) {
                        if (!call(row)) continue;
                        written = true;
                        mark<Terms...>(archetype, chunk, row);
                    } else {
                        call(row);
                    }
                }
                if constexpr (!std::is_same_v<Returned, bool>) {
                    written = chunk.rows > 0;
                    markAll(archetype, chunk);
                }
                if (written) (stamp<Terms>(archetype, chunk), ...);
            },
            columns);
    }
    template <class Term>
    static constexpr bool writesTerm() {
        if constexpr (detail::TermTraits<Term>::kHasColumn)
            return !std::is_const_v<typename detail::TermTraits<Term>::Column>;
        else
            return false;
    }
    template <class Term>
    static constexpr bool writesTracked() {
        if constexpr (writesTerm<Term>()) return kTrackRows<typename detail::TermTraits<Term>::Column>;
        return false;
    }
    template <class Term>
    void stamp(Archetype& archetype, Chunk& chunk) const {
        if constexpr (writesTerm<Term>())
            chunk.versions[size_t(
                archetype.column(componentId<typename detail::TermTraits<Term>::Column>()))] = time_.version;
    }
    template <class... Ts>
    static void mark(Archetype&, Chunk& chunk, uint32_t row) {
        if constexpr ((writesTracked<Ts>() || ...)) chunk.dirtyRows[row / 64] |= uint64_t(1) << (row % 64);
    }
    static void markAll(Archetype&, Chunk& chunk) {
        if constexpr ((writesTracked<Terms>() || ...))
            for (uint32_t row = 0; row < chunk.rows; ++row)
                chunk.dirtyRows[row / 64] |= uint64_t(1) << (row % 64);
    }
    static std::vector<std::pair<Archetype*, Chunk*>>& scratch() {
        thread_local std::vector<std::pair<Archetype*, Chunk*>> list;  // keeps its capacity from call to call
        return list;
    }

    World* world_;
    SystemTime time_;
    ComponentMask with_, without_;
};

// Access to a component of any entity, the only way to other entities' rows.
template <class T>
class Lookup {
  public:
    Lookup(World& world, SystemTime time) : world_(&world), time_(time) {}
    static void access(Access& a) { detail::TermTraits<T>::access(a); }
    T* operator()(Entity entity) const {  // null if it is dead or has none
        if constexpr (std::is_const_v<T>)
            return world_->get<std::remove_const_t<T>>(entity);
        else
            return static_cast<T*>(world_->writeAt(entity, componentId<T>(), time_.version));
    }

  private:
    World* world_;
    SystemTime time_;
};

// One of the world's resources.
template <class T>
class Res {
  public:
    Res(World& world, SystemTime) : value_(&world.resource<std::remove_const_t<T>>()) {}
    static void access(Access& a) {
        const ResourceId id = resourceId<std::remove_const_t<T>>();
        (std::is_const_v<T> ? a.resourceReads : a.resourceWrites).set(id);
    }
    T& operator*() const { return *value_; }
    T* operator->() const { return value_; }

  private:
    T* value_;
};

}  // namespace ag
