// Irradiance from virtual area lights, seen through imperfect shadow maps. Each tile of the screen sorts the
// lights: near ones are met by every pixel in their exact shape, far ones as disks.
#pragma once

#include "engine/core/setting_fields.h"
#include "gi/refresh_settings.h"
#include "gi/val_tiles.h"

namespace ag::gi {

struct ValShadingSettings {
    ValShape shape = ValShape::kPolygon;  // of near lights
    ValShape farShape = ValShape::kVectorDisk;
    float nearReach = 2;   // lights nearer than this many of their half lengths are near; 0: none
    uint32_t taps = 4;     // of near lights' soft shadows; 1: hard ones, from the light's centre
    uint32_t farTaps = 1;  // of far lights'
    bool glossy = true;  // materials reflect by their roughness, where a scene has such and lights are areas

    static constexpr auto fields() {
        return std::tuple{
            SettingField{"shape", &ValShadingSettings::shape, 0, 0, "", "form factor of a near area light",
                         "point|disk|vector_disk|rectangle|polygon"},
            SettingField{"far_shape", &ValShadingSettings::farShape, 0, 0, "",
                         "form factor of a far area light", "point|disk|vector_disk|rectangle|polygon"},
            SettingField{"near_reach", &ValShadingSettings::nearReach, 0, 1e6, "half lengths",
                         "lights nearer to a screen tile than this are met by each of its pixels; 0: none"},
            SettingField{"taps", &ValShadingSettings::taps, 1, 64, "taps",
                         "of near lights' soft shadows; 1: hard ones"},
            SettingField{"far_taps", &ValShadingSettings::farTaps, 1, 64, "taps",
                         "of far lights' soft shadows; 1: hard ones"},
            SettingField{"glossy", &ValShadingSettings::glossy, 0, 0, "",
                         "area lights shine on materials by their roughness; off: all are Lambert"}};
    }

    bool operator==(const ValShadingSettings&) const = default;
};

struct Irradiance {
    // rgba16f, W/m²; a, of what rays are cast for: standard deviation of its noise. Invalid: no light,
    // nothing to add.
    ImageHandle image;
    ImageHandle toward;  // rgba16f: vector irradiance over that along the normal; invalid: not known
};

// Passes and resources of one gathering; literals, because the graph keeps views of them.
struct ValShadingNames {
    ValTileNames tiles;
    std::string_view far, near, farIrradiance, irradiance, farToward, toward;
};
constexpr ValShadingNames kFirstShading = {
    {"val_shading.classify", "val_shading.lists", "val_shading.counts"},
    "val_shading.far",
    "val_shading.near",
    "val_shading.far_irradiance",
    "val_shading.irradiance",
    "val_shading.far_toward",
    "val_shading.toward"};
constexpr ValShadingNames kLaterShading = {
    {"val_shading.classify_later", "val_shading.lists_later", "val_shading.counts_later"},
    "val_shading.far_later",
    "val_shading.near_later",
    "val_shading.far_irradiance_later",
    "val_shading.irradiance_later",
    "val_shading.far_toward_later",
    "val_shading.toward_later"};

// Nothing of these where there is no light.
ValTiles addShadingTiles(GraphScope scope, const Surfaces& gbuffer, const ShadowedVals& lights,
                         const ValShadingSettings& settings, const ValShadingNames& names);

// `share`: only of the first bounce.
Irradiance addValShading(const ValTiles& tiles, const ValShadingSettings& settings,
                         const ValShadingNames& names, const PixelShare& share = {});
// Both.
Irradiance addValShading(GraphScope scope, const Surfaces& gbuffer, const ShadowedVals& lights,
                         const ValShadingSettings& settings, const ValShadingNames& names = kFirstShading);

// What gloss adds to the Lambert part of the lights' reflection: rgba16f, W/(m² sr), of all pixels, gathered
// at those of `downsampled` = addDownsampled(`all`) where neighbours reflect alike; pixels without a specular
// lobe cost next to nothing. Invalid: no gloss.
ImageHandle addValGloss(GraphScope scope, const Surfaces& all, const Surfaces& downsampled,
                        const ShadowedVals& lights, const ValShadingSettings& settings,
                        const PixelShare& share = {});

}  // namespace ag::gi
