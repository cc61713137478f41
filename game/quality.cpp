#include "game/quality.h"

#include <algorithm>
#include <array>

namespace ag::game {
namespace {

constexpr std::array<std::string_view, 5> kNames = {"low", "medium", "high", "ultra", "auto"};

// Less of what a CPU is slow at than the renderer's own low: it has two of them.
void trim(render::RenderSettings& gi) {
    gi.bounce.rsm.resolution = 64;
    gi.bounce.valClustering.count = 48;
    gi.bounce.valClustering.settleFrames = 8;
    gi.bounce.ismAtlas.pointsPerMap = 768;
    gi.bounce.sky.pointRays = 2;
    gi.lightClusters.most = 16;
    gi.punctualShadows.faceResolution = 256;
    gi.punctualShadows.atlasSize = 2048;
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

// Of the area lights, those of later bounces: the hand lamp's disc needs few, and a wall beside it is lit by
// later bounces alone: with half of the lights it flickers.
constexpr float kLaterShare = 0.6f;

void openEyes(render::RenderSettings& gi) {
    gi.exposure = {.automatic = true, .least = -4, .most = 4};
    gi.composite.tonemap = render::Tonemap::kAgx;
}

void applyQuality(Quality preset, render::RenderSettings& gi) {
    const render::RenderSettings before = gi;
    gi = {};
    render::applyPreset(qualityName(preset), gi);
    if (preset == Quality::kLow) trim(gi);
    render::addBounces(gi);
    gi.bounce.laterBounces.share = kLaterShare;
    gi.bounce.texelRays.enabled = false;  // the game never stands still
    gi.bounce.laterBounces.rays = 1;      // of all 4,096 points in each frame: a fifth of low's time
    gi.bounce.laterBounces.turns = 4;
    gi.composite = before.composite;
    gi.exposure = before.exposure;
    if (preset == Quality::kHigh || preset == Quality::kUltra) gi.bloom.share = 0.05f;
    gi.antialiasing = {.mode = render::Antialiasing::kTemporal,
                       .scale = preset == Quality::kLow ? 0.5f : 1.0f};
}

}  // namespace ag::game
