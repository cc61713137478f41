// How much light is worth: presets of the renderer's settings with a share of the picture's pixels, which
// anti-aliasing makes whole. The automatic choice is engine/renderer/frame_budget's.
#pragma once

#include <optional>
#include <string_view>

#include "engine/renderer/render_settings.h"

namespace ag::game {

enum class Quality : uint32_t { kLow, kMedium, kHigh, kUltra, kAutomatic };

std::optional<Quality> qualityFromName(std::string_view name);
std::string_view qualityName(Quality quality);

// An eye that gets used to dark rooms, within limits: the gallery stays darker than the garden.
void openEyes(render::RenderSettings& gi);

constexpr float kMood = -2.15f;  // stops: so much darker than what the eye gets used to

// Replaces what presets are about, with every bounce; what the eye does stays.
void applyQuality(Quality preset, render::RenderSettings& gi);

}  // namespace ag::game
