// What a View can ask for, and what a system is allowed to touch.
#pragma once

#include <tuple>

#include "engine/ecs/world.h"

namespace ag {

// Terms of a View beside T (written) and const T (read).
template <class T>
struct With {};
template <class T>
struct Without {};
// The column of chunks written since the system last ran.
template <class T>
struct Changed {};
// The column of the other chunks: those that Changed passes over.
template <class T>
struct Unchanged {};
// Of a component with kTrackRows: exactly the rows that changed since they were last taken. Taking clears
// their marks, so one system only may take a component.
template <class T>
struct Taken {};

// What a system touches, as sets: the schedule's edges come from these.
struct Access {
    ComponentMask reads, writes, takes, resourceReads, resourceWrites;
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

struct LoopCost {
    float nsPerRow = 5;  // measured; decides whether a loop is worth splitting, never what it computes
};

// Where a system stands in time: what it stamps, and what it has seen.
struct SystemTime {
    uint32_t version = 0;      // stamped on what it writes
    uint32_t lastRun = 0;      // its version when it ran before
    LoopCost* cost = nullptr;  // of the system's parallel loops
};

namespace detail {

template <class C>
struct ColumnTerm {
    using Column = C;
    using Component = std::remove_const_t<C>;
    static_assert(!std::is_empty_v<C>, "a tag has no values: ask With or Without");
    static constexpr bool kHasColumn = true, kWrites = !std::is_const_v<C>, kTakes = false;
    static constexpr bool kIfChanged = false, kIfUnchanged = false;
    static void shape(QueryShape& s) {
        s.with.set(componentId<Component>());
        AG_CHECK_LT(s.columnCount, kMostTerms);
        s.columns[s.columnCount++] = componentId<Component>();
    }
    static void access(Access& a) { (kWrites ? a.writes : a.reads).set(componentId<Component>()); }
};
struct FilterTerm {
    using Column = void;
    static constexpr bool kHasColumn = false, kWrites = false, kTakes = false, kIfChanged = false;
    static void access(Access&) {}
};

template <class T>
struct Term : ColumnTerm<T> {};
template <class T>
struct Term<With<T>> : FilterTerm {
    static void shape(QueryShape& s) { s.with.set(componentId<T>()); }
};
template <class T>
struct Term<Without<T>> : FilterTerm {
    static void shape(QueryShape& s) { s.without.set(componentId<T>()); }
};
template <class T>
struct Term<Changed<T>> : ColumnTerm<T> {
    static_assert(std::is_const_v<T>, "Changed reads: Changed<const T>");
    static constexpr bool kIfChanged = true;
};
template <class T>
struct Term<Unchanged<T>> : ColumnTerm<T> {
    static_assert(std::is_const_v<T>, "Unchanged reads: Unchanged<const T>");
    static constexpr bool kIfUnchanged = true;
};
template <class T>
struct Term<Taken<T>> : ColumnTerm<T> {
    static_assert(std::is_const_v<T>, "Taken reads: Taken<const T>");
    static_assert(kTrackRows<std::remove_const_t<T>>, "only tracked components have marks to take");
    static constexpr bool kIfChanged = true, kTakes = true;
    static void access(Access& a) {
        ColumnTerm<T>::access(a);
        a.takes.set(componentId<std::remove_const_t<T>>());
    }
};

template <class T>
using ColumnOf = std::conditional_t<Term<T>::kHasColumn, std::tuple<typename Term<T>::Column*>, std::tuple<>>;
template <class T>
using KeptTerm = std::conditional_t<Term<T>::kHasColumn, std::tuple<Term<T>>, std::tuple<>>;

template <class... Terms>
const QueryShape& queryShape() {
    static const QueryShape shape = [] {
        QueryShape s;
        s.id = nextQueryId();
        (Term<Terms>::shape(s), ...);
        return s;
    }();
    return shape;
}

}  // namespace detail
}  // namespace ag
