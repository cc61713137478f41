// Bloom: the glare that lenses and eyes put about bright things. A share of each pixel's light is spread over
// its surroundings, none is added.
#pragma once

#include "engine/core/setting_fields.h"
#include "engine/frame/frame_graph.h"

namespace ag::render {

struct BloomSettings {
    float share = 0;  // of the light; 0: no pass

    static constexpr auto fields() {
        return std::tuple{SettingField{"share", &BloomSettings::share, 0, 0.5, "",
                                       "of each pixel's light, spread about it; 0: none"}};
    }

    bool operator==(const BloomSettings&) const = default;
};

// Jimenez 2014 (Next Generation Post Processing in Call of Duty: Advanced Warfare): levels of half the size
// each, mixed on the way back. Without the source's weights by brightness, so that the mean stays.
ImageHandle addBloom(GraphScope scope, ImageHandle radiance, const BloomSettings& settings);

}  // namespace ag::render
