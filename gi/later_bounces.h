// Every bounce after the first: points spread over all surfaces reflect what fell on them a frame ago, as one
// more RSM beside those of the lights. Its texels are clustered, get shadow maps and light the screen
// like any other's, out of the same budget, and the points as well: the third bounce and all others follow
// from frame to frame. After SSVP (Aranha et al.), whose second bounce is sampled from paraboloid maps of
// clusters; here surfaces are sampled once, by area, so that flux is exact and nothing depends on the view.
#pragma once

#include "engine/core/setting_fields.h"
#include "gi/cluster_members.h"
#include "gi/settling.h"
#include "gi/surface_emitters.h"
#include "shaders/later_bounces/later_bounces_io.h"

namespace ag::gi {

struct Irradiance;
struct ShadowedVals;
struct ValShadingSettings;

struct LaterBouncesSettings {
    bool enabled = false;
    bool feedback = true;        // off: two bounces, and no more
    float share = 0.4f;          // of all clusters
    uint32_t spacing = 2;        // of the pixels bounced light is gathered at, to those later bounces are
    uint32_t settleFrames = 64;  // light goes on bouncing so long after anything last changed
    uint32_t rays = 4;           // of each point at rest: so many to lights, to points and to what is near
    uint32_t turns = 1;          // frames in which each point has rays once

    static constexpr auto fields() {
        return std::tuple{
            SettingField{"enabled", &LaterBouncesSettings::enabled, 0, 0, "",
                         "light goes on after its first bounce"},
            SettingField{"feedback", &LaterBouncesSettings::feedback, 0, 0, "",
                         "and after its second; off: no more than two"},
            SettingField{"share", &LaterBouncesSettings::share, 0.05, 0.8, "", "of all clusters"},
            SettingField{"spacing", &LaterBouncesSettings::spacing, 1, 4, "pixels",
                         "of those bounced light is gathered at, to those later bounces are"},
            SettingField{"settle_frames", &LaterBouncesSettings::settleFrames, 1, 1000000, "frames",
                         "light goes on bouncing after anything last changed"},
            SettingField{"rays", &LaterBouncesSettings::rays, 0, 16, "rays",
                         "a frame of each point to lights, to other points and to what is near, so many of "
                         "each, where texel_rays or probes' rays are; 0: area lights alone; one of each "
                         "while something moves"},
            SettingField{"turns", &LaterBouncesSettings::turns, 1, 16, "frames",
                         "in which each point has its rays once"}};
    }

    bool operator==(const LaterBouncesSettings&) const = default;
};

// What falls on the points straight: from the sky (addSkyOnPoints), from lights without an RSM
// (addLightsOnPoints), if anything does.
struct StraightLight {
    BufferHandle sky, lights;
};

// What rays of the points go to, and what they meet on the way.
struct PointRays {
    const RsmSet& rsm;
    const ClusterMembers& members;
    const Occluders& occluders;
    const SkyOnDevice& sky;  // empty: rays do not ask for it
    float reach;             // m, at most, of rays to whatever is near
    uint32_t clusterCount;
    bool still;  // nothing has changed since the frame before
    uint32_t step;
};

// What falls on the points, for the frame to come. `firstLater`: of the area lights, the first that stands
// for later bounces.
// `rays`: what corrects it, if any rays are cast.
void addLaterIrradiance(GraphScope scope, const SurfaceEmitters& emitters, const StraightLight& straight,
                        const ShadowedVals& lights, uint32_t firstLater, const LaterBouncesSettings& settings,
                        const PointRays* rays);

// `others`, of the pixels of `gbuffer`, or nothing, and what `lights`, which stand for later bounces, add to
// it. That is smoother: it is gathered at every spacing-th pixel and brought to the others along surfaces.
Irradiance addLaterShading(GraphScope scope, const Surfaces& gbuffer, const Irradiance& others,
                           const ShadowedVals& lights, uint32_t spacing, const ValShadingSettings& shading);

}  // namespace ag::gi
