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

// Replaces what presets are about; the eye's exposure stays.
void applyQuality(Quality preset, render::RenderSettings& gi);

}  // namespace ag::game
