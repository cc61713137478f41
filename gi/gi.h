// Global illumination for a host engine: hand it a RenderScene, get images. This is the only header a host
// needs.
#pragma once

#include "gi/composite.h"
#include "gi/direct_lighting.h"
#include "gi/gi_settings.h"
#include "gi/lamp_lighting.h"
#include "gi/probes.h"
#include "gi/refresh.h"
#include "gi/ssvp.h"
#include "gi/texel_shading.h"
#include "gi/upsampling.h"
#include "gi/val_fit.h"
#include "gi/vpl_sampling.h"

namespace ag::gi {

// State that outlives a frame; one per view of the scene.
struct GiHistory {
    RefreshHistory refresh;
    ClusterShares clusterShares;
    ValClusteringHistory valClustering;
    Settling stochasticRsm;
    Settling laterBounces;
    DenoiserHistory denoiser;
    SunShadowHistory sunShadows;
    LightClusterHistory lightClusters;
    LampShadowHistory lampShadows;
    LampListsHistory lampLists;
    LampRelevance lampRelevance;
    ProbeReadings probes;
};

// Everything the frame made: for composition, debug views, tests and captures.
struct GiFrame {
    GBuffer gbuffer;
    BufferHandle viewPoints;
    LaterLight laterLight;
    RsmSet rsm;
    Importance importance;
    Clusters clusters;
    Vals vals;
    SurfacePoints surfacePoints;
    IsmAtlas isms;
    uint32_t firstCount = 0;  // of the lights, those of the first bounce
    ShadowMaps shadows;
    LampShadows lampShadows;
    LampLists lampLists;
    Irradiance direct, bounce1;
    Irradiance indirect;  // of all bounces
    ImageHandle coat;     // what gloss adds to its reflection
    GiOutputs outputs;
};

// Declares the GI passes of one frame, in order. Nothing runs until the graph is executed, and then only what
// the graph's outputs need.
GiFrame addGlobalIllumination(GraphScope scope, const SceneView& scene, const GiSettings& settings,
                              GiHistory& history);

}  // namespace ag::gi
