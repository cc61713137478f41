// A player's best times in a level: of each room, and from the start to the garden.
#pragma once

#include <string>
#include <vector>

#include "engine/core/result.h"

namespace ag::game {

struct BestTimes {
    uint64_t level = 0;         // levelHash: times of another level are no measure
    double whole = 0;           // s; 0: none yet
    std::vector<double> rooms;  // s, by index; 0: none yet

    double room(int32_t index) const;
    // True if it is better than what was known; no time at all is not.
    bool noteRoom(int32_t index, double seconds);
    bool noteWhole(double seconds);
};

std::string clockText(double seconds);  // "1:04.3"

Result<BestTimes> loadBestTimes(const std::string& path);
Status saveBestTimes(const BestTimes& times, const std::string& path);

}  // namespace ag::game
