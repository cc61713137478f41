// How much light is worth: presets of the renderer's settings with a share of the window's pixels, and the
// choice among them by the time frames take.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "gi/gi_settings.h"

namespace ag::game {

enum class Quality : uint32_t { kLow, kMedium, kHigh, kUltra, kAutomatic };

std::optional<Quality> qualityFromName(std::string_view name);
std::string_view qualityName(Quality quality);

// A step on the ladder from fastest to best.
struct Rung {
    Quality preset = Quality::kLow;
    float scale = 1;  // of the window's sides that is rendered
};
std::span<const Rung> qualityLadder();
Rung rungOf(Quality quality);  // not automatic

// Replaces what presets are about; the eye's exposure stays.
void applyQuality(Quality preset, gi::GiSettings& gi);

// Climbs when frames are much shorter than asked for, and comes down when they are longer; where it had to
// come down from it does not go again.
class AutoQuality {
  public:
    explicit AutoQuality(bool cpuDevice);
    // After each frame; true if the rung changed.
    bool step(double frameMs);
    size_t rung() const { return rung_; }
    Rung current() const { return qualityLadder()[rung_]; }

  private:
    void moveTo(size_t rung);
    size_t rung_ = 0, highest_ = 0;
    double smoothMs_ = 0, seconds_ = 0;
    int frames_ = 0;
};

}  // namespace ag::game
