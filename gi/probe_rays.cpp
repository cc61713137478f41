#include "gi/probe_rays.h"

#include "engine/core/hash.h"
#include "gi/occluder_trees.h"
#include "gi/texel_rays.h"
#include "shaders/bvh/bvh_io.h"
#include "shaders/probes/probes_io.h"

namespace ag::gi {
namespace {

constexpr uint32_t kTimesAtRest = 4;  // as many rays, when other passes rest

// How likely each probe's rays go to each light: sums up to it.
BufferHandle addChances(GraphScope scope, const ProbesByLights& probes, const ProbeRaysInputs& in,
                        const io::ProbeRaysPush& push) {
    const BufferHandle upTo = scope.buffer(
        "probes.up_to",
        {.sizeBytes = scope.info(probes.ofLights).sizeBytes, .texelFormat = VK_FORMAT_R32_SFLOAT});
    PassBuilder pass = scope.compute("probes.choose", "probes/choose_lights.comp");
    pass.read("probes", probes.points)
        .read("ofLights", probes.ofLights)
        .readWrite("upTo", upTo)
        .push(push)
        .dispatchGroups(probes.room);
    readRsmTexels(pass, in.rsm);
    readMembers(pass, in.members);
    return upTo;
}

}  // namespace

bool castsProbeRays(uint32_t rays, const Occluders& occluders) {
    return rays > 0 && occluders.trees && occluders.trees.moverNodes;
}

BufferHandle addProbeRays(GraphScope frame, const ProbesByLights& probes, const ProbeRaysInputs& in,
                          const ProbeRaysCount& count, uint64_t pointsVersion, ProbeRaysHistory& history) {
    const uint64_t world = versionOfLight(in.versions, in.occluders, in.sky);
    const uint32_t step = history.settling.advance(combineHash(world, pointsVersion), count.settleFrames);
    const uint32_t still = history.settling.sinceChange;
    // Who looks does not matter: what was found stays, even where the view chooses other area lights.
    const GraphScope scope = frame.held(still > count.settleFrames);
    const HistoryBuffer means =
        scope.historyBuffer("probes.means", {.sizeBytes = probes.room * sizeof(io::ProbeMeans)});
    const bool shines = in.rsm.emissiveCount > 0,
               goesOn = in.clusters.count > in.rsm.firstLater && in.endless;
    const io::ProbeRaysPush push{
        .valCount = probes.lights.count,
        .clusterCount = in.clusters.count,
        .atlasWidth = in.rsm.atlas.size.x,
        .rays = still > 0 ? kTimesAtRest * count.rays : count.rays,
        .step = step,
        .known = means.valid,
        .still = still > 0,
        .offset = in.occluders.rayOffset,
        .texelOffset = in.occluders.trees.snapping,
        .emissiveMap = shines ? in.rsm.lightRsmCount : ~0u,
        .laterMap = goesOn ? in.rsm.atlas.mapCount - 1 : ~0u,
        .emissiveReach = shines ? reachOfPoints(in.occluders.emissivePointArea, in.reach) : 0,
        .laterReach = goesOn ? reachOfPoints(in.occluders.bouncePointArea, in.reach) : 0};
    const BufferHandle upTo = addChances(scope, probes, in, push);
    const BufferHandle rows =
        scope.buffer("probes.corrected", {.sizeBytes = probes.room * sizeof(io::ProbeRow)});
    PassBuilder pass = scope.compute("probes.trace", "probes/trace_probes.comp");
    pass.read("probes", probes.points)
        .read("rows", probes.rows)
        .read("upTo", upTo)
        .read("vals", probes.lights.vals)
        .read("skyTexels", in.sky ? in.sky.texels : in.rsm.texels)  // compiled out without
        .read("skyUpTo", in.sky ? in.sky.upTo : in.rsm.maps)
        .constant("kSky", bool(in.sky))
        .readPrevious("meansBefore", means)
        .write("means", means.current)
        .write("corrected", rows)
        .push(push)
        .dispatchGroups(probes.room);
    readRsmTexels(pass, in.rsm);
    readMembers(pass, in.members);
    readTrees(pass, in.occluders.trees);
    return rows;
}

}  // namespace ag::gi
