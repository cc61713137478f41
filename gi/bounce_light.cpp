// How indirect light is made, top to bottom. Each line takes handles and settings and returns handles; the
// frame graph finds order, barriers and what can be skipped.
#include "gi/bounce_light.h"

#include <algorithm>

#include "gi/bounce_steps.h"
#include "gi/lights_on_points.h"
#include "gi/upsampling.h"

namespace ag::gi {

bool canCastRays(const gpu::DeviceInfo& info, const BounceLightSettings& s) {
    const bool buffers =
        !info.storageTexels || info.limits.maxPerStageDescriptorStorageBuffers >= gpu::kStorageBuffersOfRays;
    return buffers && s.ismAtlas.enabled;
}

void turnRaysOff(BounceLightSettings& s) {
    s.texelRays.enabled = false;
    s.probes.rays = 0;
}

BounceLight addBounceLight(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& s,
                           BounceLightHistory& h) {
    BounceLight f{.term = s.term};
    // What may wait
    const Refresh refresh = chooseRefresh(in.world, in.surfaces.view, in.surfaces.size, s, h.refresh);
    const GraphScope lights = scope.held(!refresh.lights);

    // Where light lands, or begins, as few area lights
    f.viewPoints = addViewPoints(lights, in.surfaces);
    f.sunFocus = addSunFocus(lights, in, s.rsm, f.viewPoints, h);
    const uint64_t skyStep = stepOfSky(in, s.sky, h.skyOnPoints);
    f.emitters = addSurfaceEmitters(lights, in.world, in.occluders, skyStep, s.laterBounces, h.laterBounces);
    addAreaLights(lights, in, s, h, f);
    f.firstCount = std::min(f.vals.count, f.rsm.firstLater);

    // What each of them sees
    addVisibility(scope, in, s.ismAtlas, f);

    // Gather on screen, at some of the pixels
    const Surfaces downsampled = addDownsampled(scope, in.surfaces, s.spacing);
    const GatherGrid grid = gatherGridOf(scope, in, s, h, f);
    f.still = grid.still;
    const Surfaces gathered =
        grid.turn == 0 ? downsampled
                       : addDownsampled(scope, in.surfaces, {s.spacing, grid.place}, kOtherDownsampling);
    const Vals asked = valsOf(f, s.term);
    const bool rays = castsTexelRays(s.texelRays, in.occluders) && f.vals.count > 0;
    const bool whole = refresh.pixels.count == 1;
    const bool moving = rays && !grid.still && whole && s.texelRays.movingLength > 0;
    // Rays correct all light at once; else later bounces are gathered at fewer pixels.
    const bool together = grid.still || moving || s.laterBounces.spacing == 1;
    const ShadowedVals first{together ? asked : valsBetween(asked, 0, f.firstCount), f.isms};
    const ValTiles tiles = addShadingTiles(scope, gathered, first, s.valShading, kFirstShading);
    f.irradiance = addValShading(tiles, s.valShading, kFirstShading, refresh.pixels);
    if (!together)
        f.irradiance =
            addLaterShading(scope, gathered, f.irradiance, {valsBetween(asked, f.firstCount, ~0u), f.isms},
                            s.laterBounces.spacing, s.valShading);
    const bool probeRays =
        !in.probes.empty() && castsProbeRays(s.probes.rays, in.occluders) && f.vals.count > 0;
    const ClusterMembers members =
        rays || probeRays ? addClusterMembers(scope, f.rsm, f.clusters) : ClusterMembers{};
    const SkyOnDevice skyOfRays = s.sky.enabled ? in.sky : SkyOnDevice{};
    const float nearReach = s.texelRays.reach * in.occluders.extent;
    if (rays)
        f.irradiance = addTexelRays(tiles, f.irradiance,
                                    {f.rsm, f.clusters, members, in.occluders, skyOfRays, in.world.versions,
                                     grid, whole, moving, s.laterBounces.feedback},
                                    s.valShading, s.texelRays, h.texelRays);
    if (isFirstBounce(f, asked)) f.bounce1 = f.irradiance;
    f.gloss = addValGloss(scope, in.surfaces, downsampled, {f.vals, f.isms}, s.valShading, refresh.pixels);

    // Light that goes on
    const BufferHandle sky =
        addSkyOnPoints(scope, f.emitters, {in.sky, in.occluders, in.world.versions}, s.sky, h.skyOnPoints);
    const OtherLights otherLights = addOtherLights(scope, in.world.otherLights);
    const BufferHandle others = addLightsOnPoints(scope, f.emitters, otherLights, in.occluders);
    const PointRays pointRays{f.rsm,     members,          in.occluders, skyOfRays,
                              nearReach, f.clusters.count, grid.still,   h.laterBounces.step};
    addLaterIrradiance(scope, f.emitters, {sky, others}, {f.vals, f.isms}, f.firstCount, s.laterBounces,
                       rays || probeRays ? &pointRays : nullptr);

    // To all pixels, and to the rules of a game
    addToPixels(scope, in, gathered, s, h, f, grid);
    if (rays && s.term == Term::kAll)
        f.gloss =
            addGlossRays(scope, in.surfaces, gathered,
                         {f.rsm, f.clusters, members, in.occluders, skyOfRays, in.world, grid, otherLights,
                          s.laterBounces.feedback, f.firstCount, nearReach, f.irradiance.image, f.gloss},
                         s.glossRays, h.glossRays);
    const ProbeRaysInputs ofProbes{f.rsm,     f.clusters,        members,   in.occluders,
                                   skyOfRays, in.world.versions, nearReach, s.laterBounces.feedback};
    addProbes(scope, {in.probes, in.lightUnit}, f.rsm, {f.vals, f.isms}, s.probes, h.probes,
              probeRays ? &ofProbes : nullptr);
    return f;
}

BounceLight addStochasticLight(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& s,
                               BounceLightHistory& h) {
    BounceLight f;
    const Refresh refresh = chooseRefresh(in.world, in.surfaces.view, in.surfaces.size, s, h.refresh);
    const GraphScope lights = scope.held(!refresh.lights);

    // RSMs, and clusters of their texels that share a shadow map
    f.viewPoints = addViewPoints(lights, in.surfaces);
    addAreaLights(lights, in, s, h, f);
    f.firstCount = f.vals.count;
    addVisibility(scope, in, s.ismAtlas, f);

    // Gather on screen, at some of the pixels
    const Surfaces downsampled = addDownsampled(scope, in.surfaces, s.spacing);
    f.irradiance = f.bounce1 =
        addStochasticRsm(scope, in.world.versions, downsampled, {f.rsm, f.clusters, {f.vals, f.isms}},
                         s.stochasticRsm, h.stochasticRsm);

    // To all pixels, and to the rules of a game
    addToPixels(scope, in, downsampled, s, h, f);
    addProbes(scope, {in.probes, in.lightUnit}, f.rsm, {f.vals, f.isms}, s.probes, h.probes);
    return f;
}

BounceLight addBounceLightOn(GraphScope scope, const Surfaces& surfaces, const BounceLight& made,
                             const BounceLightSettings& s) {
    const Surfaces downsampled = addDownsampled(scope, surfaces, s.spacing);
    const ShadowedVals lights{made.vals, made.isms};
    const Irradiance gathered = addValShading(scope, downsampled, lights, s.valShading);
    BounceLight f;
    f.irradiance = addUpsampling(scope, surfaces, downsampled, gathered, kUpsampling,
                                 LightsOfPixels{lights, s.valShading.taps});
    f.gloss = addValGloss(scope, surfaces, downsampled, lights, s.valShading);
    return f;
}

}  // namespace ag::gi
