#include "engine/renderer/lamp_relevance.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "engine/renderer/lamp_lists.h"
#include "shaders/gbuffer/view_points_io.h"

namespace ag::render {

std::optional<float> LampRelevance::of(uint64_t id) const {
    const auto found = std::ranges::lower_bound(entries_, id, {}, &Entry::id);
    if (found == entries_.end() || found->id != id) return std::nullopt;
    return found->relevance;
}

void LampRelevance::set(std::span<const std::byte> rows) {
    entries_.clear();
    double sum = 0;
    for (; rows.size() >= sizeof(io::LampRelevance); rows = rows.subspan(sizeof(io::LampRelevance))) {
        io::LampRelevance row;
        std::memcpy(&row, rows.data(), sizeof row);
        if (row.relevance <= 0) continue;
        entries_.push_back({uint64_t(row.id.y) << 32 | row.id.x, row.relevance});
        sum += double(row.relevance);
    }
    mean_ = entries_.empty() ? 0 : float(sum / double(entries_.size()));
    std::ranges::sort(entries_, {}, &Entry::id);
}

namespace {

// Half a million pairs of lamp and point at most, so that thousands of lamps cost what hundreds do.
uint32_t pointsFor(uint32_t lampCount) {
    return std::clamp((1u << 19) / std::bit_ceil(std::max(lampCount, 1u)), 64u, io::kViewPointCount);
}

}  // namespace

void addLampRelevance(GraphScope scope, BufferHandle viewPoints, const LampLists& lamps,
                      LampRelevance& known) {
    if (!lamps.lamps) return;
    const auto rows = uint32_t(scope.info(lamps.lamps).sizeBytes / sizeof(io::Lamp));
    const BufferHandle relevance =
        scope.buffer("lamp_relevance.relevance", {.sizeBytes = rows * sizeof(io::LampRelevance)});
    scope.compute("lamp_relevance.measure", "direct_lighting/measure_lamps.comp")
        .read("lamps", lamps.lamps)
        .read("viewPoints", viewPoints)
        .write("relevance", relevance)
        .push(io::MeasurePush{.lampCount = lamps.lampCount, .pointCount = pointsFor(lamps.lampCount)})
        .dispatchGroups(rows);
    known.set(scope.readBack(kLampRelevanceCopies, relevance));
}

}  // namespace ag::render
