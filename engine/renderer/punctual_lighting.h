// Irradiance straight from spots and points, however many: by tiles of the screen with lists of the punctual
// lights that reach them, where a cluster's visibility is found once a pixel for all of its lights
// (LightCluster). Differences: no pixel meets lights out of reach; instead of an image of each cluster's
// visibility two images for all keep what arrives and what would without shadows, at a pixel of each 2 x 2;
// shadows come from the centre instead of a disk (PCSS), and lights far from it as seen from the receiver
// have less of them.
#pragma once

#include "engine/core/setting_fields.h"
#include "engine/renderer/direct_lighting.h"
#include "engine/renderer/punctual_lists.h"
#include "engine/renderer/punctual_shadows.h"
#include "gi/val_shading.h"

namespace ag::render {

struct PunctualLightingSettings {
    bool tiles = true;  // off: every pixel meets all lights in view
    bool quads = true;  // shadows at one pixel of each 2 x 2, the others take their neighbours' share
    // A light has all of its cluster's shadow where it is so many times farther off than from the centre,
    // nearer by in proportion less. 0: everywhere, as published.
    float shadowReach = 4;

    static constexpr auto fields() {
        return std::tuple{SettingField{"tiles", &PunctualLightingSettings::tiles, 0, 0, "",
                                       "pixels meet only lights that reach their tile"},
                          SettingField{"quads", &PunctualLightingSettings::quads, 0, 0, "",
                                       "shadows at one pixel of each 2 x 2"},
                          SettingField{"shadow_reach", &PunctualLightingSettings::shadowReach, 0, 100, "",
                                       "times a light's distance from its cluster's centre, from where on it "
                                       "has all of its shadow"}};
    }

    bool operator==(const PunctualLightingSettings&) const = default;
};

// The punctual lights in view, and their shadows.
struct PunctualLights {
    PunctualLists lists;
    PunctualShadows shadows;
};

// Adds to `before`, or starts anew where that has no image. `traced`: where shadow maps are not sure, rays
// through these.
DirectLight addPunctualLighting(GraphScope scope, const SceneView& scene, const gi::Surfaces& gbuffer,
                                const PunctualLights& lights, DirectLight before, const gi::Occluders* traced,
                                bool glossy, const PunctualLightingSettings& settings);

}  // namespace ag::render
