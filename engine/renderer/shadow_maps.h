// Depth maps of suns: cascades fitted to the camera, in an atlas.
#pragma once

#include <array>

#include "engine/core/setting_fields.h"
#include "engine/renderer/scene_gpu.h"
#include "shaders/shadow_maps/shadow_maps_io.h"

namespace ag::render {

constexpr uint32_t kMostSuns = 4;

struct ShadowMapSettings {
    uint32_t resolution = 1024;  // texels along a cascade's side
    uint32_t cascades = 3;       // of each sun, 1 to 4
    float cascadeReach = 1;      // part of the way to the scene's end that cascades share out
    float cascadeSplit = 0.75f;  // 0 uniform, 1 logarithmic
    bool rays = true;            // instead while nothing changes, where texel_rays are

    static constexpr auto fields() {
        return std::tuple{
            SettingField{"resolution", &ShadowMapSettings::resolution, 64, 4096, "texels",
                         "side of a sun's cascade"},
            SettingField{"cascades", &ShadowMapSettings::cascades, 1, 4, "", "cascades of a sun"},
            SettingField{
                "cascade_reach", &ShadowMapSettings::cascadeReach, 0.001, 1, "",
                "part of the way to the scene's end that cascades share out; the last one goes on to it"},
            SettingField{"cascade_split", &ShadowMapSettings::cascadeSplit, 0, 1, "",
                         "0 uniform, 1 logarithmic"},
            SettingField{
                "rays", &ShadowMapSettings::rays, 0, 0, "",
                "while nothing changes suns' shadows are found by rays, lamps' where maps are not sure; "
                "where texel_rays are on"}};
    }

    bool operator==(const ShadowMapSettings&) const = default;
};

struct SunShadow {
    uint32_t light = 0;  // index into the scene's lights
    uint32_t firstView = 0;
    uint32_t viewCount = 0;  // 0: casts none
};

struct ShadowMaps {
    ImageHandle atlas;   // D32; invalid if no sun casts a shadow
    BufferHandle views;  // io::ShadowView
    std::array<SunShadow, kMostSuns> suns{};
    uint32_t sunCount = 0;
};

// What is static has a layer of its own while nothing else of the maps changes than what may move.
struct SunShadowHistory {
    uint64_t staticHash = 0, movableHash = 0;  // what each layer was made of
    bool layered = false;
};

ShadowMaps addSunShadows(GraphScope scope, const SceneView& scene, const ShadowMapSettings& settings,
                         SunShadowHistory& history);

}  // namespace ag::render
