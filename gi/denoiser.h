// Irradiance from few samples a pixel made steady and smooth: over frames by reprojection, over the screen by
// an edge-avoiding à-trous filter whose first round feeds the next frame (after the article on improved
// reflective shadow maps and its sources). Any technique can put its image through. Ours besides: light that
// changes beyond noise takes over at once, single bright samples are spread over their tile instead of being
// cut off, and the filter is narrow where the mean is certain.
#pragma once

#include "engine/core/setting_fields.h"
#include "gi/surfaces.h"
#include "gi/val_shading.h"

namespace ag::gi {

struct DenoiserSettings {  // ours
    bool enabled = false;
    float leastShare = 0.01f;   // of a new frame in the mean
    uint32_t mostLength = 255;  // frames a history stands for
    uint32_t rounds = 3;        // of the filter; each doubles the distance of its taps. 0: none
    bool separable = true;      // two lines of five taps a round instead of a square of 25
    bool recurrent = false;     // the first round goes into the history, which it blurs more with every frame
    bool adaptive = true;       // light that changes takes over, bright samples are spread
    bool motion = true;         // histories follow surfaces that move
    float lightTolerance = 4;   // standard deviations by which the light of taps may differ; 0: any

    static constexpr auto fields() {
        return std::tuple{
            SettingField{"enabled", &DenoiserSettings::enabled, 0, 0, "",
                         "steady and smooth indirect light over frames and screen"},
            SettingField{"least_share", &DenoiserSettings::leastShare, 0.001, 1, "",
                         "of a new frame in the mean"},
            SettingField{"most_length", &DenoiserSettings::mostLength, 1, 2048, "frames",
                         "a history stands for"},
            SettingField{"rounds", &DenoiserSettings::rounds, 0, 5, "rounds",
                         "of the filter, each twice as wide"},
            SettingField{"separable", &DenoiserSettings::separable, 0, 0, "",
                         "filter along two lines instead of over a square"},
            SettingField{"recurrent", &DenoiserSettings::recurrent, 0, 0, "",
                         "the filter's first round goes into the history"},
            SettingField{"adaptive", &DenoiserSettings::adaptive, 0, 0, "",
                         "changing light takes over, bright samples are spread"},
            SettingField{"motion", &DenoiserSettings::motion, 0, 0, "", "histories follow what moves"},
            SettingField{"light_tolerance", &DenoiserSettings::lightTolerance, 0, 1000, "deviations",
                         "by which the light of taps may differ; 0: any"}};
    }

    bool operator==(const DenoiserSettings&) const = default;
};

struct DenoiserHistory {
    RenderCamera camera;
    uint64_t originVersion = 0, lightVersion = 0;
    uint32_t sinceLightChange = 0;  // frames
};

struct NoisyLight {
    Irradiance irradiance;
    uint64_t lightVersion =
        0;  // changes when what the light comes from does; while it does not, differences are noise
    uint32_t step = 0;  // another number for new samples; while it stays and nothing moves, nothing runs
};

// `originVersion`: of coordinates.
Irradiance addDenoiser(GraphScope scope, const Surfaces& gbuffer, uint64_t originVersion,
                       const NoisyLight& noisy, const DenoiserSettings& settings, DenoiserHistory& history);

// The camera jumped: what was known of its pixels counts for nothing.
void forgetPixels(GraphScope scope);

}  // namespace ag::gi
