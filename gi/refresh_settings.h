// What may be late where only small things move (see refresh.h).
#pragma once

#include <cstdint>

#include "engine/core/setting_fields.h"

namespace ag::gi {

struct RefreshSettings {
    // Frames from one time that lights are clustered to the next; 1: every frame, and nothing else is late.
    uint32_t lightFrames = 16;
    uint32_t pixelFrames = 8;  // in which all pixels are gathered that are as they were
    float small = 0.01f;       // of what the camera or a bounce light sees

    static constexpr auto fields() {
        return std::tuple{
            SettingField{"light_frames", &RefreshSettings::lightFrames, 1, 64, "frames",
                         "while only small things move, from one time that lights are clustered to "
                         "the next; 1: always"},
            SettingField{"pixel_frames", &RefreshSettings::pixelFrames, 1, 16, "frames",
                         "in which all pixels are gathered meanwhile that are as they were"},
            SettingField{"small", &RefreshSettings::small, 0, 1, "",
                         "of what the camera or a light sees, what counts as small"}};
    }

    bool operator==(const RefreshSettings&) const = default;
};

// Which pixels are gathered anew: all, or those whose surface is another than when they were gathered last,
// and of all tiles every count-th, of which these are the index-th.
struct PixelShare {
    bool some = false;
    uint32_t index = 0, count = 1;
};

}  // namespace ag::gi
