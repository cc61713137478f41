// Every tunable of the GI frame: a plain struct per technique, gathered here and registered once.
#pragma once

#include <glm/glm.hpp>
#include <string_view>

#include "gi/composite.h"
#include "gi/importance.h"
#include "gi/rsm.h"
#include "gi/shadow_maps.h"
#include "gi/val_clustering.h"
#include "gi/val_shading.h"

namespace ag {
class Settings;
}

namespace ag::gi {

struct GiSettings {
    RsmSettings rsm;
    ImportanceSettings importance;
    ValClusteringSettings valClustering;
    ValShadingSettings valShading;
    ShadowMapSettings shadowMaps;
    CompositeSettings composite;
};

// Adds the groups rsm, importance, val_clustering, val_shading, shadow_maps and composite. `gi` must outlive
// `settings`.
// Named sets of settings: "none" (direct light only), "rsmc" (as published), "afterglow" (the default). False
// if there is no such preset.
bool applyPreset(std::string_view name, GiSettings& gi);

void registerSettings(Settings& settings, GiSettings& gi);

}  // namespace ag::gi
