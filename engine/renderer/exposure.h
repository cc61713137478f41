// How much the picture is brightened: by hand, or by what its pixels show, as an eye or a camera does.
#pragma once

#include "engine/core/setting_fields.h"
#include "engine/frame/frame_graph.h"
#include "gi/settling.h"
#include "gi/units.h"

namespace ag::render {

struct ExposureSettings {
    bool automatic = false;
    float least = -16, most = 16;  // stops that it goes to
    float share = 0.15f;           // of the way there in a frame
    uint32_t settleFrames = 96;    // it goes on so long after anything last changed

    static constexpr auto fields() {
        return std::tuple{
            SettingField{"automatic", &ExposureSettings::automatic, 0, 0, "",
                         "the picture's mean goes to middle gray; composite.exposure is on top"},
            SettingField{"least", &ExposureSettings::least, -40, 40, "stops", "that it goes to"},
            SettingField{"most", &ExposureSettings::most, -40, 40, "stops", "that it goes to"},
            SettingField{"share", &ExposureSettings::share, 0.001, 1, "", "of the way there in a frame"},
            SettingField{"settle_frames", &ExposureSettings::settleFrames, 1, 1000000, "frames",
                         "it goes on after anything last changed"}};
    }

    bool operator==(const ExposureSettings&) const = default;
};

// `radiance` is in `units`. `compensation`: stops on top, log2 of the unit of light included. `inputsVersion`
// changes with whatever changes the picture, settings too. Gives an io::Exposure; invalid: exposure is by
// hand.
BufferHandle addExposure(GraphScope scope, ImageHandle radiance, const gi::RenderUnits& units,
                         float compensation, uint64_t inputsVersion, const ExposureSettings& settings,
                         gi::Settling& settling);

}  // namespace ag::render
