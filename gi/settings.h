// Every tunable of our indirect light: a plain struct per technique, gathered here.
#pragma once

#include <string_view>

#include "gi/denoiser.h"
#include "gi/gloss_rays.h"
#include "gi/importance.h"
#include "gi/ism_atlas.h"
#include "gi/later_bounces.h"
#include "gi/probes.h"
#include "gi/refresh_settings.h"
#include "gi/rsm.h"
#include "gi/sky.h"
#include "gi/stochastic_rsm.h"
#include "gi/texel_rays.h"
#include "gi/val_clustering.h"
#include "gi/val_shading.h"

namespace ag::gi {

// What irradiance is of.
enum class Term : uint32_t { kAll, kBounces, kFirstBounce, kLaterBounces, kEmissive };

struct BounceLightSettings {
    Term term = Term::kAll;  // of our area lights' light; less than all for who looks at one alone
    uint32_t spacing = 2;    // pixels from one that indirect light is gathered at to the next
    RsmSettings rsm;
    ImportanceSettings importance;
    ValClusteringSettings valClustering;
    IsmAtlasSettings ismAtlas;
    LaterBouncesSettings laterBounces;
    ValShadingSettings valShading;
    TexelRaysSettings texelRays;
    GlossRaysSettings glossRays;
    StochasticRsmSettings stochasticRsm;
    DenoiserSettings denoiser;
    ProbeSettings probes;
    SkySettings sky;
    RefreshSettings refresh;

    bool operator==(const BounceLightSettings&) const = default;
};

// Ours by budget: "low", "medium" (the default), "high", "ultra". False if there is no such quality.
bool applyQuality(std::string_view name, BounceLightSettings& s);

// Registers every group's settings. `s` must outlive `settings`.
void registerSettings(Settings& settings, BounceLightSettings& s);

}  // namespace ag::gi
