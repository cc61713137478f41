// Rays from probes to texels of the reflective shadow maps: what area lights and their imperfect shadow maps
// get wrong at a probe. While the scene changes, the ratio of the rays' mean to the area lights' mean over
// some frames scales the area lights' light. In a still scene the rays' mean replaces it.
#pragma once

#include <cstdint>
#include <vector>

#include "gi/cluster_members.h"
#include "gi/settling.h"
#include "gi/sky.h"
#include "gi/val_shading.h"

namespace ag::gi {

// What the rays go to, and what they meet on the way.
struct ProbeRaysInputs {
    const RsmSet& rsm;
    const Clusters& clusters;
    const ClusterMembers& members;
    const Occluders& occluders;
    const SkyOnDevice& sky;
    const Versions& versions;
    float reach;   // m, at most: of rays to whatever is near
    bool endless;  // light goes on after its second bounce
};

// Lives on the CPU from frame to frame.
struct ProbeRaysHistory {
    Settling settling;
    std::vector<uint64_t> ids;  // of the frame before's probes, by row
};

// What probes.evaluate made of the same probes.
struct ProbesByLights {
    BufferHandle points;    // io::Probe
    BufferHandle rows;      // io::ProbeRow
    BufferHandle ofLights;  // float, by probe and area light
    uint32_t room;          // rows, of which some may stand for no probe
    const Vals& lights;
};

// Whether any are cast for probes: there is something to trace them through.
bool castsProbeRays(uint32_t rays, const Occluders& occluders);

struct ProbeRaysCount {
    uint32_t rays;  // of each probe a frame while something changes
    uint32_t settleFrames;
};

// The rows with bounced light by rays. `pointsVersion`: another whenever a probe was moved, came or went.
BufferHandle addProbeRays(GraphScope scope, const ProbesByLights& probes, const ProbeRaysInputs& in,
                          const ProbeRaysCount& count, uint64_t pointsVersion, ProbeRaysHistory& history);

}  // namespace ag::gi
