#include "gi/gather_grid.h"

#include <algorithm>
#include <utility>

#include "engine/core/hash.h"
#include "gi/surfaces.h"

namespace ag::gi {
namespace {

uint32_t turnsOf(const BounceLightSettings& s) {
    return s.texelRays.allPixels ? s.spacing * s.spacing : 1;
}

// While clusters or later bounces change, what they send does, and means are made anew: without new rays the
// last ones would count again and again. Light of the sky on points goes on to later bounces.
uint32_t raysOfTurn(const BounceLightSettings& s, uint32_t turn) {
    if (turn > 0) return s.texelRays.settleFrames;
    const uint32_t bounces = s.laterBounces.enabled ? s.laterBounces.settleFrames + s.sky.settleFrames : 0;
    return std::max({s.texelRays.settleFrames, s.valClustering.settleFrames, bounces});
}

// A frame in which the surfaces are new comes before the rays.
constexpr uint32_t kBegins = 1;

constexpr uint32_t kMostRaysOfTurn = 1 << 20;  // pixels of another turn draw other numbers
constexpr uint32_t kGrowingLength = 32;

}  // namespace

uint32_t rayNumber(const GatherGrid& grid, const Settling& settling) {
    return std::min(settling.sinceChange, grid.frames) + grid.turn * kMostRaysOfTurn;
}

float meanLength(const GatherGrid& grid, uint32_t most) {
    return float(grid.grows ? std::min(kGrowingLength, most) : most);
}

float keptShare(const GatherGrid& grid) {
    return grid.turn == 0 ? 31.0f / 32 : 1;
}

uint32_t framesToRest(const BounceLightSettings& s) {
    uint32_t frames = 0;
    for (uint32_t turn = 0; turn < turnsOf(s); ++turn)
        frames += kBegins + raysOfTurn(s, turn);
    return frames;
}

GatherGrid chooseGatherGrid(uint64_t light, uint64_t camera, bool castsRays, const BounceLightSettings& s,
                            GatherGridHistory& h) {
    h.changes += std::exchange(h.settings, s) != s;
    const uint64_t inputs = combineHash(combineHash(light, castsRays), h.changes);
    h.light.advance(inputs, framesToRest(s));
    h.settling.advance(combineHash(inputs, camera), framesToRest(s));
    const bool changed = h.light.sinceChange == 0;
    h.restarts += changed;
    GatherGrid grid{.still = castsRays && !changed,
                    .grows = s.laterBounces.enabled && h.light.sinceChange <= s.laterBounces.settleFrames,
                    .change = h.restarts};
    const uint32_t turns = castsRays ? turnsOf(s) : 1;
    uint32_t since = h.settling.sinceChange;
    while (grid.turn + 1 < turns && since >= kBegins + raysOfTurn(s, grid.turn))
        since -= kBegins + raysOfTurn(s, grid.turn++);
    grid.begins = since == 0;
    grid.frames = raysOfTurn(s, grid.turn);
    grid.place = Downsampling::ofTurn(s.spacing, grid.turn).place;
    return grid;
}

}  // namespace ag::gi
