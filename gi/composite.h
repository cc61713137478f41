// The last steps: outgoing radiance of what the camera sees, and its display image.
#pragma once

#include "gi/gbuffer.h"
#include "gi/val_shading.h"

namespace ag::gi {

enum class Tonemap : uint32_t { kNone, kReinhard, kAces };

struct CompositeSettings {
    float exposure = 0;  // stops
    Tonemap tonemap = Tonemap::kAces;

    bool operator==(const CompositeSettings&) const = default;
};

struct GiOutputs {
    ImageHandle radiance;  // rgba16f, W/(m² sr); alpha 0 where no surface is seen
    ImageHandle display;   // rgba8, sRGB-encoded
};

// `coat`: radiance that gloss adds.
GiOutputs addComposite(GraphScope scope, const GBuffer& gbuffer, const Irradiance& direct,
                       const Irradiance& indirect, ImageHandle coat, const CompositeSettings& settings);

}  // namespace ag::gi
