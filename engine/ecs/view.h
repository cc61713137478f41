// Entities by what they have, as a system's parameter. Its type says everything it touches: const is read,
// the rest is written, and what is not named does not compile.
//
//   void flickerLamps(View<PointLight, const Flicker> lamps, Res<const FrameTime> time);
#pragma once

#include <bit>

#include "engine/ecs/commands.h"
#include "engine/ecs/lookup.h"
#include "engine/ecs/pieces.h"
#include "engine/ecs/scratch.h"

namespace ag {

// Where the spans of a loop over chunks lie.
struct RowRun {
    const Chunk* chunk = nullptr;
    uint32_t first = 0;  // row of the chunk
    std::span<const Entity> entities;
};

template <class... Terms>
class View {
    using Piece = detail::Piece;
    using Columns = decltype(std::tuple_cat(detail::ColumnOf<Terms>{}...));
    using Kept = decltype(std::tuple_cat(detail::KeptTerm<Terms>{}...));  // terms that have a column
    static constexpr size_t kColumns = std::tuple_size_v<Columns>;
    static constexpr bool kTakes = (detail::Term<Terms>::kTakes || ...);

  public:
    View(World& world, SystemTime time)
        : matches_(world.matches(detail::queryShape<Terms...>())), time_(time) {}
    static void access(Access& a) { (detail::Term<Terms>::access(a), ...); }

    // f(T&...) or f(Entity, T&...) for each row. If f returns a bool it says whether it changed the row: only
    // such rows are marked, and a chunk counts as written only if it has one.
    template <class F>
    void each(F&& f) const {
        forChunks([&](const Piece& piece) { rows(piece, f); });
    }
    // f(std::span<T>...) or f(const RowRun&, std::span<T>...) for each chunk, or with Taken for each run of
    // changed rows; what is written counts as written.
    template <class F>
    void chunks(F&& f) const {
        forChunks([&](const Piece& piece) { spans(piece, f); });
    }
    // The same with the rows shared out over the runner's threads; f must not touch other rows' data.
    template <class F>
    void parallel(JobRunner& runner, F&& f) const {
        split(runner, [&](uint32_t, const Piece& piece) { rows(piece, f); });
    }
    template <class F>
    void parallelChunks(JobRunner& runner, F&& f) const {
        split(runner, [&](uint32_t, const Piece& piece) { spans(piece, f); });
    }
    // f(Commands&, Entity, T&...): the commands are played in the order of the rows.
    template <class F>
    void parallel(JobRunner& runner, Commands& commands, F&& f) const {
        Scratch<Piece> pieces;
        cut(*pieces);
        const std::span<const std::unique_ptr<Commands>> parts = commands.parts(uint32_t(pieces->size()));
        detail::runPieces(runner, *pieces, time_.cost, [&](uint32_t i) {
            rows((*pieces)[i],
                 [&](Entity entity, auto&... values) { return f(*parts[i], entity, values...); });
        });
    }
    // f(R&, T&...) or f(R&, Entity, T&...) into a copy of `start` a piece; then join(R&, const R&) over the
    // pieces in order. The same bits for any number of threads.
    template <class R, class F, class Join>
    R fold(JobRunner& runner, const R& start, F&& f, Join&& join) const {
        static_assert(!std::is_same_v<R, bool>, "a vector's bools share words: fold into an int");
        Scratch<Piece> pieces;
        Scratch<R> parts;
        cut(*pieces);
        parts->assign(pieces->size(), start);
        detail::runPieces(runner, *pieces, time_.cost, [&](uint32_t i) {
            R part = start;
            rows((*pieces)[i], [&](Entity entity, auto&... values) {
                if constexpr (std::is_invocable_v<F&, R&, Entity, decltype(values)...>)
                    f(part, entity, values...);
                else
                    f(part, values...);
            });
            (*parts)[i] = part;
        });
        R all = start;
        for (const R& part : *parts)
            join(all, part);
        return all;
    }
    uint32_t count() const {  // rows of the chunks it would visit
        uint32_t sum = 0;
        forChunks([&](const Piece& piece) { sum += piece.end; });
        return sum;
    }
    bool empty() const { return count() == 0; }

  private:
    template <class F>
    static void overKept(F&& f) {
        [&]<size_t... I>(std::index_sequence<I...>) {
            (f.template operator()<std::tuple_element_t<I, Kept>>(I), ...);
        }
        (std::make_index_sequence<kColumns>{});
    }
    bool wanted([[maybe_unused]] const QueryMatch& match, [[maybe_unused]] const Chunk& chunk) const {
        bool all = true;
        overKept([&]<class T>(size_t i) {
            if constexpr (T::kIfChanged || T::kIfUnchanged)
                all = all && T::kIfChanged == (newerThan(chunk.versions[match.columns[i]], time_.lastRun) ||
                                               newerThan(chunk.structureVersion, time_.lastRun));
        });
        return all;
    }
    template <class F>
    void forChunks(F&& f) const {
        for (size_t m = 0; m < matches_.size(); ++m) {
            const QueryMatch& match = matches_[m];
            prefetchMatches(m);
            for (const auto& chunk : match.archetype->chunks)
                if (wanted(match, *chunk)) f(Piece{&match, chunk.get(), 0, chunk->rows});
        }
    }
    // The way to a chunk has three steps; those of the next archetypes are taken ahead, one each.
    void prefetchMatches(size_t m) const {
        if (m + 3 < matches_.size()) __builtin_prefetch(matches_[m + 3].archetype);
        if (m + 2 < matches_.size()) __builtin_prefetch(matches_[m + 2].archetype->chunks.data());
        if (m + 1 < matches_.size() && matches_[m + 1].archetype->last)
            __builtin_prefetch(matches_[m + 1].archetype->chunks.front().get());
    }
    void cut(std::vector<Piece>& pieces) const {
        forChunks([&](const Piece& whole) { detail::cutChunk(*whole.match, *whole.chunk, pieces); });
    }
    template <class F>
    void split(JobRunner& runner, F&& f) const {
        Scratch<Piece> pieces;
        cut(*pieces);
        detail::runPieces(runner, *pieces, time_.cost, [&](uint32_t i) { f(i, (*pieces)[i]); });
    }
    template <class F>
    static void withColumns(const Piece& piece, F&& f) {
        [&]<size_t... I>(std::index_sequence<I...>) {
            f(reinterpret_cast<std::tuple_element_t<I, Columns>>(
                piece.chunk->columns[piece.match->columns[I]])...);
        }
        (std::make_index_sequence<kColumns>{});
    }
    template <class F>
    void rows(const Piece& piece, F&& f) const {
        withColumns(piece, [&](auto*... column) {
            const Entity* entities = piece.chunk->entities;
            const auto call = [&](uint32_t row) {
                if constexpr (std::is_invocable_v<F&, Entity, decltype(*column)...>)
                    return f(entities[row], column[row]...);
                else
                    return f(column[row]...);
            };
            constexpr bool kSays = std::is_same_v<decltype(call(0)), bool>;
            const uint32_t end = piece.end;
            if constexpr (kTakes) {
                forRuns(piece, [&](uint32_t first, uint32_t last) {
                    for (uint32_t row = first; row < last; ++row)
                        call(row);
                    touch({piece.match, piece.chunk, first, last});
                });
            } else if constexpr (kSays) {
                sayingRows(piece, call);
            } else {
                for (uint32_t row = piece.begin; row < end; ++row)
                    call(row);
                touch(piece);
            }
        });
    }
    template <class F>
    void spans(const Piece& piece, F&& f) const {
        const auto give = [&](uint32_t begin, uint32_t end) {
            withColumns(piece, [&](auto*... column) {
                const uint32_t count = end - begin;
                if constexpr (std::is_invocable_v<F&, const RowRun&, decltype(std::span(column, 0))...>)
                    f(RowRun{piece.chunk, begin, {piece.chunk->entities + begin, count}},
                      std::span(column + begin, count)...);
                else
                    f(std::span(column + begin, count)...);
                touch({piece.match, piece.chunk, begin, end});
            });
        };
        if constexpr (kTakes) {
            forRuns(piece, give);
        } else if (piece.begin < piece.end) {
            give(piece.begin, piece.end);
        }
    }
    // Rows whose function says whether it changed them: marks are gathered and set a word at a time.
    template <class Call>
    void sayingRows(const Piece& piece, Call&& call) const {
        bool any = false;
        for (uint32_t base = piece.begin; base < piece.end; base += 64) {
            uint64_t changed = 0;
            for (uint32_t row = base, end = std::min(base + 64, piece.end); row < end; ++row)
                changed |= uint64_t(call(row)) << (row - base);
            if (!changed) continue;
            any = true;
            overKept([&]<class T>(size_t i) {
                if constexpr (T::kWrites && kTrackRows<typename T::Component>)
                    piece.chunk->rowBits[piece.match->columns[i]][base / 64] |= changed;
            });
        }
        if (any) stamp(piece);
    }
    void stamp(const Piece& piece) const {
        overKept([&]<class T>(size_t i) {
            if constexpr (T::kWrites)
                stampVersion(piece.chunk->versions[piece.match->columns[i]], time_.version);
        });
    }
    void touch(const Piece& piece) const {
        if (piece.begin == piece.end) return;
        stamp(piece);
        overKept([&]<class T>(size_t i) {
            if constexpr (T::kWrites && kTrackRows<typename T::Component>)
                setBits(piece.chunk->rowBits[piece.match->columns[i]], piece.begin, piece.end);
        });
    }
    // f(first, last) for each run of marked rows; clears the marks.
    template <class F>
    static void forRuns(const Piece& piece, F&& f) {
        uint64_t* words = nullptr;
        overKept([&]<class T>(size_t i) {
            if constexpr (T::kTakes) words = piece.chunk->rowBits[piece.match->columns[i]];
        });
        uint32_t first = piece.begin, last = piece.begin;
        for (uint32_t base = piece.begin; base < piece.end; base += 64) {
            uint64_t bits = std::exchange(words[base / 64], 0);
            if (piece.end - base < 64) bits &= ~(~uint64_t(0) << (piece.end - base));
            while (bits) {
                const auto skip = uint32_t(std::countr_zero(bits)),
                           length = uint32_t(std::countr_one(bits >> skip));
                if (base + skip != last) {
                    if (first < last) f(first, last);
                    first = base + skip;
                }
                last = base + skip + length;
                bits = skip + length == 64 ? 0 : bits & (~uint64_t(0) << (skip + length));
            }
        }
        if (first < last) f(first, last);
    }

    std::span<const QueryMatch> matches_;
    SystemTime time_;
};

}  // namespace ag
