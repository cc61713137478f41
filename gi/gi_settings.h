// Every tunable of the GI frame: a plain struct per technique, gathered here and registered once.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string_view>

#include "gi/composite.h"
#include "gi/denoiser.h"
#include "gi/importance.h"
#include "gi/ism_atlas.h"
#include "gi/lamp_lighting.h"
#include "gi/later_bounces.h"
#include "gi/probes.h"
#include "gi/refresh_settings.h"
#include "gi/rsm.h"
#include "gi/shadow_maps.h"
#include "gi/ssvp.h"
#include "gi/stochastic_rsm.h"
#include "gi/val_clustering.h"
#include "gi/val_shading.h"

namespace ag {
class Settings;
}

namespace ag::gi {

// Where the first bounce comes from.
enum class FirstBounce : uint32_t {
    kNone,           // no indirect light, and nothing that only it needs
    kAreaLights,     // clusters of light-map texels
    kPointLights,    // sampled light-map texels
    kTexels,         // every light-map texel as a point emitter
    kStochasticRsm,  // samples of the light maps
    kSsvp,           // point lights, and what they light: two bounces
};

struct GiSettings {
    FirstBounce firstBounce = FirstBounce::kAreaLights;
    uint32_t spacing = 2;  // pixels from one that indirect light is gathered at to the next
    RsmSettings rsm;
    ImportanceSettings importance;
    ValClusteringSettings valClustering;
    IsmAtlasSettings ismAtlas;
    LaterBouncesSettings laterBounces;
    ValShadingSettings valShading;
    SsvpSettings ssvp;
    StochasticRsmSettings stochasticRsm;
    DenoiserSettings denoiser;
    ShadowMapSettings shadowMaps;
    LightClusterSettings lightClusters;
    LampShadowSettings lampShadows;
    LampLightingSettings lampLighting;
    ProbeSettings probes;
    RefreshSettings refresh;
    CompositeSettings composite;

    bool operator==(const GiSettings&) const = default;
};

// Named sets of settings: "none" (direct light only), "rsm-brute" (every texel of a 128² light map),
// "rsm-400" (Dachsbacher & Stamminger 2005), "irsm" (few samples and a denoiser, as published), "stochastic"
// (that, ours), "ism" (Ritschel et al. 2008), "ssvp" (two bounces, as published), "rsmc" (RSM clustering) and
// "acrsm" (with adaption and shadows) as published, "afterglow" (the default), "afterglow-bounces" (with
// every later bounce), and the default by budget: "low", "medium" (the same), "high", "ultra". For the direct
// light of lamps, without bounces: "lights-reference" (a shadow map each), "lightcluster" as published,
// "afterglow-lights" (the default's). False if there is no such preset.
bool applyPreset(std::string_view name, GiSettings& gi);
std::span<const std::string_view> presetNames();

// Registers every group's settings. `gi` must outlive `settings`.
void registerSettings(Settings& settings, GiSettings& gi);

}  // namespace ag::gi
