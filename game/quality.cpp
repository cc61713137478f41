#include "game/quality.h"

#include <algorithm>
#include <array>

namespace ag::game {
namespace {

constexpr std::array<std::string_view, 5> kNames = {"low", "medium", "high", "ultra", "auto"};
constexpr std::array<Rung, 6> kLadder = {{{Quality::kLow, 0.5f},
                                          {Quality::kLow, 0.75f},
                                          {Quality::kLow, 1},
                                          {Quality::kMedium, 1},
                                          {Quality::kHigh, 1},
                                          {Quality::kUltra, 1}}};
constexpr size_t kCpuStart = 1, kGpuStart = 4;
constexpr double kLongMs = 90, kShortMs = 14;  // a frame: come down, climb
constexpr double kDownSeconds = 1.2, kUpSeconds = 3;
constexpr int kWarmFrames = 4;  // after a change: shaders are compiled

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

std::span<const Rung> qualityLadder() {
    return kLadder;
}

Rung rungOf(Quality quality) {
    return quality == Quality::kLow ? Rung{Quality::kLow, 0.5f} : Rung{quality, 1};
}

void applyQuality(Quality preset, gi::GiSettings& gi) {
    const gi::CompositeSettings eye = gi.composite;
    gi = {};
    gi::applyPreset(qualityName(preset), gi);
    if (preset == Quality::kLow) trim(gi);
    gi.composite = eye;
}

AutoQuality::AutoQuality(bool cpuDevice)
    : rung_(cpuDevice ? kCpuStart : kGpuStart), highest_(kLadder.size() - 1) {}

void AutoQuality::moveTo(size_t rung) {
    rung_ = rung;
    frames_ = 0;
    seconds_ = smoothMs_ = 0;
}

bool AutoQuality::step(double frameMs) {
    if (++frames_ <= kWarmFrames) return false;
    smoothMs_ = smoothMs_ == 0 ? frameMs : smoothMs_ + (frameMs - smoothMs_) * 0.1;
    seconds_ += frameMs * 1e-3;
    if (smoothMs_ > kLongMs && seconds_ > kDownSeconds && rung_ > 0) {
        highest_ = rung_ - 1;
        moveTo(rung_ - 1);
        return true;
    }
    if (smoothMs_ < kShortMs && seconds_ > kUpSeconds && rung_ < highest_) {
        moveTo(rung_ + 1);
        return true;
    }
    return false;
}

}  // namespace ag::game
