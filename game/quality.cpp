#include "game/quality.h"

#include <algorithm>
#include <array>

namespace ag::game {
namespace {

constexpr std::array<std::string_view, 5> kNames = {"low", "medium", "high", "ultra", "auto"};
// Less of what a CPU is slow at than the renderer's own low: it has two of them.
void trim(gi::GiSettings& gi) {
    gi.rsm.resolution = 64;
    gi.valClustering.count = 48;
    gi.valClustering.settleFrames = 8;
    gi.ismAtlas.pointsPerMap = 768;
    gi.lightClusters.most = 16;
    gi.lampShadows.faceResolution = 256;
    gi.lampShadows.atlasSize = 2048;
}

}  // namespace

std::optional<Quality> qualityFromName(std::string_view name) {
    const auto found = std::ranges::find(kNames, name);
    if (found == kNames.end()) return std::nullopt;
    return Quality(found - kNames.begin());
}

std::string_view qualityName(Quality quality) {
    return kNames[size_t(quality)];
}

float renderScale(Quality quality) {
    return quality == Quality::kLow ? 0.5f : 1.0f;
}

void applyQuality(Quality preset, gi::GiSettings& gi) {
    const gi::CompositeSettings eye = gi.composite;
    gi = {};
    gi::applyPreset(qualityName(preset), gi);
    if (preset == Quality::kLow) trim(gi);
    gi.composite = eye;
}

}  // namespace ag::game
