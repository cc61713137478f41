#include "game/systems/flicker_lamps.h"

#include <cmath>

#include "shaders/common/sampling.h"

namespace ag::game {
namespace {

// Of one turn, 0 to 1.
float strengthAt(const Flicker& f, uint64_t turn) {
    const uint32_t random = io::hashUint(io::hashUint(f.seed) + uint32_t(turn));
    if (io::hashToUnit(random) < f.off) return 0;
    return 1 - f.depth * io::hashToUnit(random + 1);
}

}  // namespace

void flickerLamps(View<PunctualLight, const Flicker> lamps, Res<const GameTime> time) {
    lamps.each([&](PunctualLight& light, const Flicker& f) {
        const double turns = time->seconds / double(f.period);
        const auto turn = uint64_t(turns);
        const float between = float(turns - double(turn)), smooth = between * between * (3 - 2 * between);
        light.intensity = f.intensity * std::lerp(strengthAt(f, turn), strengthAt(f, turn + 1), smooth);
    });
}

}  // namespace ag::game
