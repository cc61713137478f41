#include "engine/renderer/punctual_relevance.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "engine/renderer/punctual_lists.h"
#include "shaders/gbuffer/view_points_io.h"

namespace ag::render {

std::optional<float> PunctualRelevance::of(uint64_t id) const {
    const auto found = std::ranges::lower_bound(entries_, id, {}, &Entry::id);
    if (found == entries_.end() || found->id != id) return std::nullopt;
    return found->relevance;
}

void PunctualRelevance::set(std::span<const std::byte> rows) {
    entries_.clear();
    double sum = 0;
    for (; rows.size() >= sizeof(io::PunctualRelevance); rows = rows.subspan(sizeof(io::PunctualRelevance))) {
        io::PunctualRelevance row;
        std::memcpy(&row, rows.data(), sizeof row);
        if (row.relevance <= 0) continue;
        entries_.push_back({uint64_t(row.id.y) << 32 | row.id.x, row.relevance});
        sum += double(row.relevance);
    }
    mean_ = entries_.empty() ? 0 : float(sum / double(entries_.size()));
    std::ranges::sort(entries_, {}, &Entry::id);
}

namespace {

// Half a million pairs of punctual light and point at most, so that thousands of punctual lights cost what
// hundreds do.
uint32_t pointsFor(uint32_t lightCount) {
    return std::clamp((1u << 19) / std::bit_ceil(std::max(lightCount, 1u)), 64u, io::kViewPointCount);
}

}  // namespace

void addPunctualRelevance(GraphScope scope, BufferHandle viewPoints, const PunctualLists& lights,
                          PunctualRelevance& known) {
    if (!lights.lights) return;
    const auto rows = uint32_t(scope.info(lights.lights).sizeBytes / sizeof(io::PunctualLight));
    const BufferHandle relevance =
        scope.buffer("punctual_relevance.relevance", {.sizeBytes = rows * sizeof(io::PunctualRelevance)});
    scope.compute("punctual_relevance.measure", "direct_lighting/measure_punctual.comp")
        .read("lights", lights.lights)
        .read("viewPoints", viewPoints)
        .write("relevance", relevance)
        .push(io::MeasurePush{.lightCount = lights.lightCount, .pointCount = pointsFor(lights.lightCount)})
        .dispatchGroups(rows);
    known.set(scope.readBack(kPunctualRelevanceCopies, relevance));
}

}  // namespace ag::render
