// Where on the RSM clusters are worth having: reflected flux, and with a view weight how much a block faces
// what the camera sees (RSMC section 4, ACRSM sections 4.4-4.5). One value a block of at least 4x4 texels
// (the sources: one a texel), at most 64x64 a face, summed into a 2x2 pyramid for warping.
#pragma once

#include "engine/core/setting_fields.h"
#include "gi/rsm.h"
#include "gi/surfaces.h"
#include "shaders/importance/importance_io.h"

namespace ag::gi {

struct ImportanceSettings {
    float viewWeight = 0.7f;  // w_v: 0 flux alone (clusters then do not depend on the camera), 1 view alone

    static constexpr auto fields() {
        return std::tuple{SettingField{"view_weight", &ImportanceSettings::viewWeight, 0, 1, "",
                                       "seed clusters by flux (0) or by what faces the view (1)"}};
    }

    bool operator==(const ImportanceSettings&) const = default;
};

struct Importance {
    BufferHandle pyramid;  // floats, per face: see shaders/importance/pyramid.glsl
    uint32_t pyramidStride = 0;
    BufferHandle viewPoints;  // io::ViewPoint, also a texel buffer of vec4; invalid unless viewDependent
    float viewWeight = 0;
    bool viewDependent() const { return viewWeight > 0; }
};

Importance addImportance(GraphScope scope, const RsmSet& rsm, BufferHandle viewPoints,
                         const ImportanceSettings& settings);

}  // namespace ag::gi
