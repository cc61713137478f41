// Imperfect shadow maps (Ritschel et al. 2008; ACRSM section 5.3.2): small depth maps of what each virtual
// light sees, splatted from points on the surfaces and closed by pull-push. Hemispheres in one
// buffer, a square tile a light; each tile takes points of its own,
// more of them from surfaces near by. A map whose light and points did not move is not splatted again.
// Differences: a texel keeps the nearest surface's plane instead of its depth, so that no bias is needed and
// a surface never shadows itself; and where the host has trees of its occluders, static surfaces are traced,
// a ray a texel, and only what moves is splatted.
#pragma once

#include "engine/core/setting_fields.h"
#include "gi/surface_points.h"
#include "gi/val_fit.h"
#include "shaders/ism_atlas/ism_atlas_io.h"

namespace ag::gi {

enum class IsmMapping : uint32_t { kOctahedral, kParaboloid };

struct IsmAtlasSettings {
    bool enabled = true;           // off: bounced light passes through everything
    bool traced = true;            // static surfaces by rays, where there are trees; off: all by points
    uint32_t tileSize = 48;        // texels along a map's side, a multiple of 16 up to 128
    uint32_t pointsPerMap = 1536;  // splatted into each map
    bool nearMore = true;          // points by the solid angle of surfaces instead of their area
    float splatScale = 1.1f;       // of the points' disks, which at 1 have the surfaces' area
    IsmMapping mapping = IsmMapping::kOctahedral;
    bool planes = true;    // what texels keep; off: distances with a bias of a disk, as in the sources
    bool keepMaps = true;  // of lights that stand still before points that do; not with skipping off
    bool pullPush = true;  // close the holes between points

    static constexpr auto fields() {
        return std::tuple{
            SettingField{"enabled", &IsmAtlasSettings::enabled, 0, 0, "", "visibility of indirect light"},
            SettingField{"traced", &IsmAtlasSettings::traced, 0, 0, "",
                         "static surfaces by rays through the host's trees; off: all from points"},
            SettingField{"tile_size", &IsmAtlasSettings::tileSize, 16, 128, "texels",
                         "side of a light's depth map, rounded down to a multiple of 16"},
            SettingField{"points_per_map", &IsmAtlasSettings::pointsPerMap, 64, 131072, "points",
                         "splatted into each depth map"},
            SettingField{"near_more", &IsmAtlasSettings::nearMore, 0, 0, "",
                         "more points from surfaces near the light, fewer far off"},
            SettingField{"splat_scale", &IsmAtlasSettings::splatScale, 0.1, 10, "",
                         "of the points' disks; at 1 they have the surfaces' area"},
            SettingField{"mapping", &IsmAtlasSettings::mapping, 0, 0, "", "of the hemisphere to a square",
                         "octahedral|paraboloid"},
            SettingField{"planes", &IsmAtlasSettings::planes, 0, 0, "",
                         "texels keep planes; off: distances with a bias of a disk"},
            SettingField{"keep_maps", &IsmAtlasSettings::keepMaps, 0, 0, "",
                         "do not splat again for lights that stand still"},
            SettingField{"pull_push", &IsmAtlasSettings::pullPush, 0, 0, "",
                         "close the holes between points"}};
    }

    bool operator==(const IsmAtlasSettings&) const = default;
};

struct IsmAtlas {
    BufferHandle planes;  // vec4; also a texel buffer; invalid: no visibility
    BufferHandle chosen;  // per map its static points, see ism_light.glsl; invalid where these are traced
    BufferHandle states;  // io::IsmMapState
    uint32_t pointsPerMap = 0;
    uint32_t mapCount = 0;
    uint32_t tileSize = 0;
    IsmMapping mapping = IsmMapping::kOctahedral;
    bool shared = false;  // not one a light: which one, a point light's shape row says
};

// Area lights, and what each of them sees.
struct ShadowedVals {
    Vals vals;
    IsmAtlas isms;
};

// `trees`: may be none. `points`: of all surfaces, or of nothing where trees stand for all.
IsmAtlas addIsmAtlas(GraphScope scope, const SurfacePoints& points, const TracedOccluders& trees,
                     const Vals& vals, const IsmAtlasSettings& settings);

}  // namespace ag::gi
