// First-bounce irradiance from samples of the RSMs about each pixel's projection:
// reflective shadow maps as Dachsbacher & Stamminger (2005) gather them, with one fixed pattern for all
// pixels and, if asked for, their interpolation in screen space; or few samples, others in each pixel and
// frame (improved reflective shadow maps), for the denoiser.
#pragma once

#include "engine/core/setting_fields.h"
#include "gi/ism_atlas.h"
#include "gi/rsm.h"
#include "gi/settling.h"
#include "gi/surfaces.h"
#include "gi/val_clustering.h"
#include "gi/val_fit.h"
#include "gi/val_shading.h"
#include "shaders/stochastic_rsm/stochastic_rsm_io.h"

namespace ag::gi {

struct StochasticRsmSettings {
    uint32_t samples = 400;    // of each RSM, a pixel
    float radius = 0.3f;       // of the disk they lie in, in widths of the map: light beyond it is lost
    bool interpolate = false;  // gather every fourth pixel both ways and blend where surfaces are alike
    bool random = false;       // others in each pixel and frame
    bool whole = false;    // every other sample from all of the map, so that no light is lost; not of points
    bool visible = false;  // samples as far as their cluster's imperfect shadow map lets them be seen
    uint32_t settleFrames = 64;  // frames with new samples after anything last changed

    static constexpr auto fields() {
        return std::tuple{
            SettingField{"samples", &StochasticRsmSettings::samples, 1, 4096, "samples",
                         "of each RSM, a pixel"},
            SettingField{"radius", &StochasticRsmSettings::radius, 0.001, 2, "map widths",
                         "of the disk about the pixel's projection; light beyond it is lost"},
            SettingField{"interpolate", &StochasticRsmSettings::interpolate, 0, 0, "",
                         "gather a 16th of the pixels, blend where surfaces are alike"},
            SettingField{"random", &StochasticRsmSettings::random, 0, 0, "",
                         "other samples in each pixel and frame, for the denoiser"},
            SettingField{"whole", &StochasticRsmSettings::whole, 0, 0, "",
                         "every other sample from all of the map, so that no light is lost"},
            SettingField{"visible", &StochasticRsmSettings::visible, 0, 0, "",
                         "samples as far as their cluster's imperfect shadow map lets them be seen"},
            SettingField{"settle_frames", &StochasticRsmSettings::settleFrames, 0, 1000000, "frames",
                         "with new samples after anything last changed"}};
    }

    bool operator==(const StochasticRsmSettings&) const = default;
};

// Texels to sample, their clusters, and the map of what each cluster sees; without these samples are seen.
struct SampledRsm {
    const RsmSet& rsm;
    Clusters clusters;
    ShadowedVals lights;
};

Irradiance addStochasticRsm(GraphScope scope, const Versions& versions, const Surfaces& gbuffer,
                            const SampledRsm& of, const StochasticRsmSettings& settings, Settling& settling);

}  // namespace ag::gi
