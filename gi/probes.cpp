#include "gi/probes.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "engine/core/hash.h"
#include "gi/val_tiles.h"

namespace ag::gi {
namespace {

constexpr uint64_t kNoProbe = ~uint64_t(0);  // of rows that fill the buffer up

uint64_t idOf(uint32_t low, uint32_t high) {
    return uint64_t(high) << 32 | low;
}

// One more than the row that a probe had in the frame before; 0: none. `after`: the answer for the probe
// before it in the list, mostly one less.
uint32_t rowOf(uint64_t id, std::span<const uint64_t> before, uint32_t after) {
    if (after < before.size() && before[after] == id) return after + 1;
    const auto found = std::ranges::find(before, id);
    return found == before.end() ? 0 : uint32_t(found - before.begin()) + 1;
}

// Rows in powers of two, so that a probe more does not make a new buffer. `before`: the ids of the rows of
// the frame before.
BufferHandle uploadProbes(GraphScope scope, std::span<const RenderProbe> probes,
                          std::vector<uint64_t>& before) {
    const uint32_t room = std::bit_ceil(std::max(uint32_t(probes.size()), 16u));
    const BufferHandle buffer = scope.buffer("probes.points", {.sizeBytes = room * sizeof(io::Probe)});
    static thread_local std::vector<io::Probe> rows;  // keeps its memory from frame to frame
    rows.clear();
    uint32_t row = 0;
    for (const RenderProbe& p : probes) {
        row = rowOf(p.id, before, row);
        rows.push_back({p.position, uint32_t(p.id), p.normal, uint32_t(p.id >> 32), row});
    }
    before.resize(probes.size());
    std::ranges::transform(probes, before.begin(), &RenderProbe::id);
    rows.resize(room, {.idLow = uint32_t(kNoProbe), .idHigh = uint32_t(kNoProbe >> 32)});
    scope.upload("probes.points", buffer, std::as_bytes(std::span(rows)));
    return buffer;
}

// Another number when a probe was moved, came or went.
uint64_t versionOf(std::span<const RenderProbe> probes) {
    uint64_t hash = probes.size();
    for (const RenderProbe& p : probes) {
        hash = combineHash(hash, p.id);
        hash = combineHash(hash, hashBytes(std::as_bytes(std::span(&p.position, 1))));
        hash = combineHash(hash, hashBytes(std::as_bytes(std::span(&p.normal, 1))));
    }
    return hash;
}

}  // namespace

std::optional<ProbeReading> ProbeReadings::of(uint64_t id) const {
    const auto found = std::ranges::lower_bound(rows_, id, {}, &Row::id);
    if (found == rows_.end() || found->id != id) return std::nullopt;
    return found->reading;
}

void ProbeReadings::set(std::span<const std::byte> rows, float lightUnit) {
    rows_.clear();
    for (; rows.size() >= sizeof(io::ProbeRow); rows = rows.subspan(sizeof(io::ProbeRow))) {
        io::ProbeRow row;
        std::memcpy(&row, rows.data(), sizeof row);
        const uint64_t id = idOf(row.idLow, row.idHigh);
        if (id != kNoProbe) rows_.push_back({id, {row.direct * lightUnit, row.bounced * lightUnit}});
    }
    std::ranges::sort(rows_, {}, &Row::id);
}

void ProbeReadings::setDark(std::span<const RenderProbe> probes) {
    rows_.clear();
    for (const RenderProbe& p : probes)
        rows_.push_back({p.id, {}});
    std::ranges::sort(rows_, {}, &Row::id);
}

void addProbes(GraphScope scope, const ProbePoints& at, const RsmSet& rsm, const ShadowedVals& lights,
               const ProbeSettings& settings, ProbeHistory& h, const ProbeRaysInputs* rays) {
    const auto& [vals, isms] = lights;
    if (at.probes.empty()) return h.readings.clear();
    if (rsm.empty() || vals.count == 0) return h.readings.setDark(at.probes);
    const auto probes = at.probes.first(std::min<size_t>(at.probes.size(), kMostProbes));
    const BufferHandle points = uploadProbes(scope, probes, h.rays.ids);
    const uint64_t room = scope.info(points).sizeBytes / sizeof(io::Probe);
    const BufferHandle ofLights =
        scope.buffer("probes.of_lights", {.sizeBytes = room * vals.count * sizeof(float)});
    const BufferHandle rows = scope.buffer("probes.rows", {.sizeBytes = room * sizeof(io::ProbeRow)});
    PassBuilder pass = scope.compute("probes.evaluate", "probes/evaluate_probes.comp");
    readLights(pass, lights, settings.shape, settings.taps);
    pass.sample("depthMap", rsm.depth)
        .read("faces", rsm.faces)
        .read("maps", rsm.maps)
        .read("probes", points)
        .write("ofLights", ofLights)
        .write("rows", rows)
        .push(io::ProbePush{
            .valCount = vals.count, .faceCount = rsm.lightFaceCount, .ismTileSize = isms.tileSize})
        .dispatchGroups(uint32_t(room));
    if (!rays) h.rays = {};  // what was known is of other rows by the time they are cast again
    const BufferHandle measured =
        rays ? addProbeRays(scope, {points, rows, ofLights, uint32_t(room), vals}, *rays,
                            {settings.rays, settings.settleFrames}, versionOf(probes), h.rays)
             : rows;
    h.readings.set(scope.readBack(kProbeCopies, measured), at.lightUnit);
}

}  // namespace ag::gi
