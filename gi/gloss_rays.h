// Gloss of area lights corrected by rays while nothing changes. Area lights stand for what a specular lobe
// reflects as bells, which says little of where lobes are narrow, or seen at grazing angles. Each pixel with
// a specular lobe casts two rays a frame, one drawn by the lobe and one to a texel drawn by what the lobe
// would reflect of it, and takes the light of the surfaces they meet. Means over frames, filtered by their
// variance. Pixels have their turns as those of texel_rays have.
#pragma once

#include "engine/core/setting_fields.h"
#include "gi/cluster_members.h"
#include "gi/lights_on_points.h"
#include "gi/settling.h"
#include "gi/sky.h"

namespace ag::gi {

struct GatherGrid;

struct GlossRaysSettings {
    bool enabled = true;
    uint32_t mostLength = 1024;  // frames that a mean stands for
    uint32_t rounds = 3;         // of the filter
    float tolerance = 1;         // standard deviations by which the light of taps may differ

    static constexpr auto fields() {
        return std::tuple{
            SettingField{"enabled", &GlossRaysSettings::enabled, 0, 0, "",
                         "correct area lights' gloss by rays while nothing changes, where texel_rays are"},
            SettingField{"most_length", &GlossRaysSettings::mostLength, 1, 2048, "frames",
                         "a pixel's mean stands for"},
            SettingField{"rounds", &GlossRaysSettings::rounds, 1, 4, "rounds",
                         "of the filter, each twice as wide"},
            SettingField{"tolerance", &GlossRaysSettings::tolerance, 0.01, 1000, "deviations",
                         "by which the light of taps may differ"}};
    }

    bool operator==(const GlossRaysSettings&) const = default;
};

// Lives on the CPU from frame to frame.
struct GlossRaysHistory {
    Settling settling;
    RenderCamera camera, gatheredCamera;  // of all pixels, and of those that had their turn
    uint64_t originVersion = 0;
    uint32_t sinceRays = ~0u;  // frames
};

struct GlossRaysInputs {
    const RsmSet& rsm;
    const Clusters& clusters;
    const ClusterMembers& members;
    const Occluders& occluders;
    const SkyOnDevice& sky;  // that light goes on of; none: it does not
    const World& world;
    const GatherGrid& grid;
    const OtherLights& others;  // without maps
    bool endless;               // light goes on after its second bounce
    uint32_t firstLater;        // of the area lights, the first that stands for later bounces
    float nearReach;            // m: most that rays to what is near have
    ImageHandle irradiance;     // that area lights send to all pixels, W/m²
    ImageHandle gloss;          // of area lights, W/(m² sr)
};

// `gathered`: the pixels of `surfaces` that have their turn. At all of these, as `in.gloss`.
ImageHandle addGlossRays(GraphScope scope, const Surfaces& surfaces, const Surfaces& gathered,
                         const GlossRaysInputs& in, const GlossRaysSettings& settings,
                         GlossRaysHistory& history);

}  // namespace ag::gi
