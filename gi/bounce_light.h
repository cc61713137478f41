// Indirect light for any renderer: hand over what the camera sees, lights, and points on surfaces; get
// irradiance, gloss and readings of probes. The passes are declared in a graph and run when that is executed.
#pragma once

#include "engine/core/function_ref.h"
#include "engine/gpu/device_info.h"
#include "gi/gather_grid.h"
#include "gi/inputs.h"
#include "gi/refresh.h"
#include "gi/settings.h"
#include "gi/sky.h"
#include "gi/surface_points.h"
#include "gi/val_fit.h"

namespace ag::gi {

struct BounceLightInputs {
    Surfaces surfaces;
    World world;
    Occluders occluders;
    SkyOnDevice sky;
    // Draws what the lights of planRsm see (rsm.h).
    FunctionRef<void(GraphScope, RsmSet&)> drawRsm;
    std::span<const RenderProbe> probes;
    float lightUnit = 1;  // W/m² in one of the light's numbers, for readings of probes
};

// State that outlives a frame; one per view of the scene.
struct BounceLightHistory {
    RefreshHistory refresh;
    RsmHistory rsm;
    SunFocusHistory sunFocus;
    ValClusteringHistory valClustering;
    GatherGridHistory gatherGrid;
    TexelRaysHistory texelRays;
    GlossRaysHistory glossRays;
    Settling stochasticRsm;
    Settling laterBounces;
    Settling skyOnPoints;
    DenoiserHistory denoiser;
    ProbeHistory probes;
};

// What was made, with all that it was made from: for composition, debug views, tests and captures.
struct BounceLight {
    Irradiance irradiance;  // of the settings' term
    Irradiance bounce1;     // of the first bounce alone; the same image where there is no other light
    ImageHandle gloss;      // what glossy materials reflect beyond irradiance: rgba16f, W/(m² sr)

    BufferHandle viewPoints;
    SunFocus sunFocus;
    SurfaceEmitters emitters;
    RsmSet rsm;
    Importance importance;
    Clusters clusters;
    Vals vals;
    Term term = Term::kAll;   // of irradiance
    bool still = false;       // rays are cast: nothing has changed since the frame before
    uint32_t firstCount = 0;  // of the lights, those of emissive surfaces and of the first bounce
    SurfacePoints surfacePoints;
    IsmAtlas isms;
};

// Whether rays to lights can be cast on a device; not for light without visibility.
bool canCastRays(const gpu::DeviceInfo& info, const BounceLightSettings& settings);
// Settings with which none are cast, neither of pixels nor of probes.
void turnRaysOff(BounceLightSettings& settings);

// Where light lands, as few area lights that see through shadow maps of their own; and where it goes on.
BounceLight addBounceLight(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& settings,
                           BounceLightHistory& history);

// The same light on other surfaces than it was made for, such as glass before them: irradiance of all bounces
// and gloss alone.
BounceLight addBounceLightOn(GraphScope scope, const Surfaces& surfaces, const BounceLight& made,
                             const BounceLightSettings& settings);

// The first bounce from a few samples of the RSMs a pixel, seen through the same shadow maps, denoised.
BounceLight addStochasticLight(GraphScope scope, const BounceLightInputs& in,
                               const BounceLightSettings& settings, BounceLightHistory& history);

}  // namespace ag::gi
