#include "tools/noise/void_and_cluster.h"

#include <algorithm>
#include <cmath>

#include "shaders/common/sampling.h"

namespace ag::noise {
namespace {

constexpr float kSigma = 1.5f;  // pixels; Ulichney's choice
constexpr int kReach = 7;       // the Gaussian is nothing beyond it

// Pixels that are set, and how crowded each place is.
class Torus {
  public:
    explicit Torus(uint32_t side)
        : side_(int(side)), crowding_(side * side, 0.0f), set_(side * side, false) {}

    void change(uint32_t pixel, bool set) {
        set_[pixel] = set;
        const int px = int(pixel) % side_, py = int(pixel) / side_;
        for (int y = -kReach; y <= kReach; ++y)
            for (int x = -kReach; x <= kReach; ++x) {
                const int at = (py + y + side_) % side_ * side_ + (px + x + side_) % side_;
                const float weight = std::exp(-float(x * x + y * y) / (2 * kSigma * kSigma));
                crowding_[size_t(at)] += set ? weight : -weight;
            }
    }
    // Of the pixels that are set or not: the most crowded, or the least.
    uint32_t extreme(bool among, bool most) const {
        uint32_t best = ~0u;
        for (uint32_t i = 0; i < crowding_.size(); ++i) {
            if (set_[i] != among) continue;
            const bool better =
                best == ~0u || (most ? crowding_[i] > crowding_[best] : crowding_[i] < crowding_[best]);
            if (better) best = i;
        }
        return best;
    }
    bool isSet(uint32_t pixel) const { return set_[pixel]; }

  private:
    int side_;
    std::vector<float> crowding_;
    std::vector<bool> set_;
};

// A tenth of the pixels, moved from clusters into voids until that changes nothing.
Torus startPattern(uint32_t side, uint32_t seed, uint32_t& count) {
    Torus torus(side);
    count = 0;
    for (uint32_t i = 0; count < side * side / 10; ++i) {
        const uint32_t pixel = io::hashUint(seed * 977 + i) % (side * side);
        if (torus.isSet(pixel)) continue;
        torus.change(pixel, true);
        ++count;
    }
    for (uint32_t round = 0; round < side * side; ++round) {
        const uint32_t cluster = torus.extreme(true, true);
        torus.change(cluster, false);
        const uint32_t hole = torus.extreme(false, false);
        torus.change(hole, true);
        if (hole == cluster) break;
    }
    return torus;
}

}  // namespace

std::vector<uint32_t> voidAndCluster(uint32_t side, uint32_t seed) {
    std::vector<uint32_t> ranks(side * side, 0);
    uint32_t count = 0;
    const Torus start = startPattern(side, seed, count);
    Torus torus = start;
    for (uint32_t rank = count; rank-- > 0;) {  // the pattern backwards: the most crowded goes first
        const uint32_t pixel = torus.extreme(true, true);
        torus.change(pixel, false);
        ranks[pixel] = rank;
    }
    torus = start;
    for (uint32_t rank = count; rank < side * side; ++rank) {
        const uint32_t pixel = torus.extreme(false, false);
        torus.change(pixel, true);
        ranks[pixel] = rank;
    }
    return ranks;
}

}  // namespace ag::noise
