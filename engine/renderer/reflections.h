// What smooth surfaces reflect of the picture itself: rays of narrow specular lobes walk over the depth of
// what the camera sees, and what they meet takes the place of area lights in the lobe. Whatever they do not
// find on the screen stays as area lights have it, and the sky as its own rays have it. All of it is of this
// frame, so that nothing has to settle.
#pragma once

#include "engine/core/setting_fields.h"
#include "engine/renderer/gbuffer.h"
#include "gi/bounce_light.h"

namespace ag::render {

struct ReflectionSettings {
    bool enabled = true;
    float roughness = 0.15f;  // rougher lobes are left to area lights; from four fifths of it on by degrees
    uint32_t rays = 2;        // of a pixel
    uint32_t steps = 64;      // of a ray over the picture, at most
    float thickness = 0.01f;  // share of its distance that a surface is thick at least

    static constexpr auto fields() {
        return std::tuple{SettingField{"enabled", &ReflectionSettings::enabled, 0, 0, "",
                                       "smooth surfaces reflect what the camera sees"},
                          SettingField{"roughness", &ReflectionSettings::roughness, 0, 0.5, "",
                                       "rougher surfaces are left to area lights"},
                          SettingField{"rays", &ReflectionSettings::rays, 1, 64, "", "of a pixel"},
                          SettingField{"steps", &ReflectionSettings::steps, 8, 1024, "",
                                       "of a ray over the picture, at most"},
                          SettingField{"thickness", &ReflectionSettings::thickness, 0, 1, "",
                                       "share of its distance that a surface is thick at least"}};
    }

    bool operator==(const ReflectionSettings&) const = default;
};

// The picture with reflections of itself; as it was where no material is smooth.
ImageHandle addReflections(GraphScope scope, const SceneView& scene, const GBuffer& gbuffer,
                           const gi::BounceLight& bounce, ImageHandle radiance,
                           const ReflectionSettings& settings);

}  // namespace ag::render
