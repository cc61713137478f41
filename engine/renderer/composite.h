// The last steps: outgoing radiance of what the camera sees, and its display image.
#pragma once

#include "engine/core/setting_fields.h"
#include "engine/renderer/direct_lighting.h"
#include "engine/renderer/exposure.h"
#include "engine/renderer/gbuffer.h"
#include "gi/bounce_light.h"

namespace ag::render {

enum class Tonemap : uint32_t { kNone, kReinhard, kAces, kNeutral, kAgx };

struct CompositeSettings {
    float exposure = 0;  // stops
    Tonemap tonemap = Tonemap::kAces;
    bool dither = true;

    static constexpr auto fields() {
        return std::tuple{
            SettingField{"exposure", &CompositeSettings::exposure, -20, 20, "stops", "of the display image"},
            SettingField{"tonemap", &CompositeSettings::tonemap, 0, 0, "", "curve of the display image",
                         "none|reinhard|aces|neutral|agx"},
            SettingField{"dither", &CompositeSettings::dither, 0, 0, "",
                         "half a step of the display's 8 bits by place, so that gradients have no bands"}};
    }

    bool operator==(const CompositeSettings&) const = default;
};

struct RenderOutputs {
    ImageHandle radiance;   // rgba16f, W/(m² sr), anti-aliased; alpha 0 where no surface is seen
    ImageHandle display;    // rgba8, sRGB-encoded
    BufferHandle exposure;  // io::Exposure; invalid: by hand
};

struct CompositeLight {
    const DirectLight& direct;
    const gi::SkyLight& sky;
    const gi::BounceLight& bounce;
    const SceneView& scene;  // whose sky is seen where no surface is
};

// What is seen where no surface is.
enum class Behind { kSky, kMore };  // kMore: more of the picture, which this is put over
ImageHandle addRadiance(GraphScope scope, const GBuffer& gbuffer, const CompositeLight& light,
                        Behind behind = Behind::kSky);
// `exposure`: see addExposure; where invalid, the settings'.
ImageHandle addDisplay(GraphScope scope, const GBuffer& gbuffer, ImageHandle radiance, BufferHandle exposure,
                       const CompositeSettings& settings);

}  // namespace ag::render
