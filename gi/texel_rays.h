// The light of area lights corrected by rays. The lights' sum is smooth, but wrong where a light is near or
// its shadow map is coarse. Each pixel measures the error with two rays a frame to texels of the reflective
// shadow maps, through the occluders' trees; the area lights' sum is a control variate of that measurement.
// Means over frames follow their surfaces and are filtered by their variance. In frames in which only some of
// the pixels are gathered no rays are cast: surfaces keep what was found on them.
#pragma once

#include <array>

#include "engine/core/setting_fields.h"
#include "gi/cluster_members.h"
#include "gi/settling.h"
#include "gi/sky.h"
#include "gi/val_shading.h"

namespace ag::gi {

struct GatherGrid;

struct TexelRaysSettings {
    bool enabled = true;
    float reach = 0.05f;          // of a hemisphere's ray, in the scene's extent
    uint32_t mostLength = 1024;   // frames that a mean stands for
    uint32_t settleFrames = 256;  // frames with new rays after anything last changed
    uint32_t movingLength = 48;   // frames that a mean stands for while something changes; 0: no rays then
    bool allPixels = true;        // then by the pixels that were left out, one after another
    uint32_t rounds = 3;          // of the filter
    float tolerance = 1;          // standard deviations by which the light of taps may differ

    static constexpr auto fields() {
        return std::tuple{
            SettingField{"enabled", &TexelRaysSettings::enabled, 0, 0, "",
                         "correct the light of area lights by rays to texels"},
            SettingField{"reach", &TexelRaysSettings::reach, 0, 1, "scene extents",
                         "of rays to whatever light is near"},
            SettingField{"most_length", &TexelRaysSettings::mostLength, 1, 2048, "frames",
                         "a pixel's mean stands for"},
            SettingField{"settle_frames", &TexelRaysSettings::settleFrames, 0, 1000000, "frames",
                         "with new rays after anything last changed"},
            SettingField{"moving_length", &TexelRaysSettings::movingLength, 0, 1024, "frames",
                         "a pixel's mean stands for while something changes; 0: no rays are cast then"},
            SettingField{"all_pixels", &TexelRaysSettings::allPixels, 0, 0, "",
                         "then gather at the pixels left out, too, while nothing changes"},
            SettingField{"rounds", &TexelRaysSettings::rounds, 0, 4, "rounds",
                         "of the filter, each twice as wide"},
            SettingField{"tolerance", &TexelRaysSettings::tolerance, 0.01, 1000, "deviations",
                         "by which the light of taps may differ"}};
    }

    bool operator==(const TexelRaysSettings&) const = default;
};

// Lives on the CPU from frame to frame.
struct TexelRaysHistory {
    Settling settling;
    bool whole = true;   // every pixel's area lights were of that frame
    uint32_t casts = 0;  // frames up to that one, in a row, whose draws learned from one another
    uint64_t world = 0;  // of what rays find, but the camera
    RenderCamera camera;
    uint64_t originVersion = 0;
    // Of the lights of the frame before: identities, and the luminance of what each sent.
    uint32_t lightCount = 0;
    std::array<uint64_t, io::kMaxLightMaps> lightIds{};
    std::array<float, io::kMaxLightMaps> lightStrengths{};
};

// What the rays go to, and what they meet on the way.
struct TexelRaysInputs {
    const RsmSet& rsm;
    const Clusters& clusters;
    const ClusterMembers& members;
    const Occluders& occluders;
    const SkyOnDevice& sky;  // that later bounces have light of; none: they have not
    const Versions& versions;
    const GatherGrid& grid;
    bool whole = true;    // every pixel's area lights are of this frame
    bool moving = false;  // something changed, and rays are cast all the same
    bool endless = true;  // light goes on after its second bounce
};

// How near surfaces are for which points of so much area stand badly: they are no even surface. `most`, m.
float reachOfPoints(float area, float most);

// Whether any are cast: `settings` ask for them, and there is something to trace them through.
bool castsTexelRays(const TexelRaysSettings& settings, const Occluders& occluders);

// Another number whenever what rays find may have changed, but for who sees it.
uint64_t versionOfLight(const Versions& versions, const Occluders& occluders, const SkyOnDevice& sky);

// `areaLights`: what they send by `tiles`; the same corrected.
Irradiance addTexelRays(const ValTiles& tiles, const Irradiance& areaLights, const TexelRaysInputs& in,
                        const ValShadingSettings& shading, const TexelRaysSettings& settings,
                        TexelRaysHistory& history);

}  // namespace ag::gi
