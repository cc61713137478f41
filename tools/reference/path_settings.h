// What is traced.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "tools/reference/pixel_filter.h"

namespace ag::reference {

struct PathSettings {
    uint32_t bounces = 1;  // most; 0: direct light alone
    bool glossy = false;   // metallic-roughness with its GGX specular lobe; else the diffuse part as Lambert
    bool unshadowed = false;  // bounced light passes through surfaces; one bounce, of suns and lamps alone
    bool emission = true;     // emissive surfaces light others, too
    PixelFilter filter = PixelFilter::kCenter;
    bool litPoints = true;  // bounced light is looked for from the lights, too
    // Camera rays meet surfaces that blend with what is behind them, each by chance; no others do. For
    // radiance alone: irradiance is then a mixture of sheets and what is behind them.
    bool blended = false;

    // Places of a pixel are drawn, each with direct light of its own.
    bool drawsPlaces() const { return blended || filter != PixelFilter::kCenter; }
};

// Bounces that are kept apart; further ones only count in `indirect`.
constexpr uint32_t kBouncesApart = 8;

}  // namespace ag::reference
