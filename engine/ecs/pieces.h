// How a view's rows are cut for several threads. The cut depends on the rows alone, never on threads or
// times, so what is folded piece by piece comes out the same everywhere.
#pragma once

#include <chrono>

#include "engine/ecs/terms.h"
#include "engine/jobs/job_graph.h"

namespace ag::detail {

constexpr uint32_t kPieceRows = 1024;       // of one chunk; a multiple of a word of row bits
constexpr float kWorthSplittingNs = 40e3f;  // below, waking another thread costs more than it brings
constexpr uint32_t kPiecesPerThread = 8;    // enough for a late thread to be helped

struct Piece {
    const QueryMatch* match;
    Chunk* chunk;
    uint32_t begin, end;  // rows
};

inline void cutChunk(const QueryMatch& match, Chunk& chunk, std::vector<Piece>& pieces) {
    for (uint32_t begin = 0; begin < chunk.rows; begin += kPieceRows)
        pieces.push_back({&match, &chunk, begin, std::min(chunk.rows, begin + kPieceRows)});
}

// Calls body(index) for every piece: whole if the measured cost of the rows is not worth a second thread.
template <class F>
void runPieces(JobRunner& runner, const std::vector<Piece>& pieces, LoopCost* cost, F&& body) {
    if (pieces.empty()) return;
    using Clock = std::chrono::steady_clock;
    LoopCost none;
    LoopCost& known = cost ? *cost : none;
    uint32_t rows = 0;
    for (const Piece& piece : pieces)
        rows += piece.end - piece.begin;
    const auto count = uint32_t(pieces.size());
    const bool split =
        runner.threadCount() > 1 && count > 1 && float(rows) * known.nsPerRow > kWorthSplittingNs;
    const auto begin = Clock::now();
    auto end = begin;
    if (split) {
        const uint32_t grain = count / (runner.threadCount() * kPiecesPerThread);
        runner.parallelFor(count, grain, [&](uint32_t first, uint32_t last) {
            const auto started = first == 0 ? Clock::now() : begin;
            for (uint32_t i = first; i < last; ++i)
                body(i);
            if (first > 0) return;
            rows = 0;  // only the first task's are timed
            for (uint32_t i = first; i < last; ++i)
                rows += pieces[i].end - pieces[i].begin;
            end = begin + (Clock::now() - started);
        });
    } else {
        for (uint32_t i = 0; i < count; ++i)
            body(i);
        end = Clock::now();
    }
    const float ns = float(std::chrono::duration<double, std::nano>(end - begin).count());
    known.nsPerRow += (ns / float(rows) - known.nsPerRow) * 0.25f;
}

}  // namespace ag::detail
