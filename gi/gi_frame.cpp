// What the GPU does each frame, top to bottom. Each line takes handles and settings and returns handles; the
// frame graph finds order, barriers and what can be skipped.
#include "gi/gi.h"

#include <algorithm>

#include "engine/core/hash.h"

namespace ag::gi {

GiFrame addGlobalIllumination(GraphScope scope, const SceneView& scene, const GiSettings& s, GiHistory& h) {
    GiFrame f;
    // What may wait
    const Refresh refresh = chooseRefresh(scene, s, h.refresh);

    // Figures as they are bent now
    addSkinning(scope, scene);

    // What the camera sees
    f.gbuffer = addGBuffer(scope, scene);
    const GraphScope lights = scope.held(!refresh.lights);
    f.viewPoints = addViewPoints(lights, scene, f.gbuffer);

    // First bounce: where light lands, as few lights
    if (s.firstBounce == FirstBounce::kAreaLights)
        f.laterLight = addLaterLight(lights, scene, s.laterBounces, h.laterBounces);  // of the frame before
    f.rsm = addRsm(lights, scene, s.rsm, s.valClustering.count, f.laterLight, h.clusterShares);
    f.importance = addImportance(lights, f.rsm, f.viewPoints, s.importance);
    f.clusters = addValClustering(lights, f.rsm, f.importance, s.valClustering, scene.scene->cameraVersion,
                                  h.valClustering);
    if (s.firstBounce == FirstBounce::kPointLights)
        f.vals = addVplSampling(lights, f.rsm, f.importance, s.valClustering.count);
    else if (s.firstBounce != FirstBounce::kSsvp)
        f.vals = addValFit(lights, f.rsm, f.laterLight, f.clusters);
    f.firstCount = std::min(f.vals.count, f.rsm.firstLater());

    // What each of them sees
    if (f.vals.count > 0 && s.ismAtlas.enabled) f.surfacePoints = addSurfacePoints(scope, scene);
    f.isms = addIsmAtlas(scope, f.surfacePoints, f.vals, s.ismAtlas);
    if (s.firstBounce == FirstBounce::kSsvp) {  // the lights, and among them what they light
        const Ssvp propagated = addSsvp(scope, scene, f.rsm, s.valClustering.count, s.ssvp);
        f.vals = propagated.vals, f.firstCount = propagated.firstCount;
        if (s.ismAtlas.enabled) f.isms = propagated.maps;
    }

    // Gather on screen, at some of the pixels
    GBuffer thin = addThinned(scope, f.gbuffer, s.spacing);
    if (s.firstBounce == FirstBounce::kTexels)
        f.bounce1 = addTexelShading(scope, thin, f.rsm);
    else if (s.firstBounce == FirstBounce::kStochasticRsm)
        f.bounce1 = addStochasticRsm(scope, scene, thin, f.rsm, {f.clusters, f.vals, f.isms}, s.stochasticRsm,
                                     h.stochasticRsm);
    else if (s.firstBounce != FirstBounce::kNone)
        f.bounce1 = addValShading(scope, thin, firstVals(f.vals, f.firstCount), f.isms, s.valShading,
                                  kFirstBounceShading, refresh.pixels);
    if (s.firstBounce == FirstBounce::kAreaLights)  // at all that have it
        f.coat = addValGloss(scope, f.gbuffer, f.vals, f.isms, s.valShading, refresh.pixels);

    // Light that goes on
    f.indirect = f.bounce1;
    addLaterIrradiance(scope, f.laterLight, f.vals, f.firstCount, f.isms, s.laterBounces);
    const bool goesOn = f.bounce1.image && f.vals.count > f.firstCount;
    const uint32_t apart = f.laterLight.texels ? s.laterBounces.spacing : 1;
    if (goesOn)
        f.indirect =
            addLaterShading(scope, thin, f.bounce1, f.vals, f.firstCount, f.isms, s.valShading, apart);

    // Steady and smooth
    if (s.denoiser.enabled && s.denoiser.motion && f.indirect.image) {
        f.gbuffer.motion = addMotion(scope, scene, f.gbuffer);
        thin.motion = addThinImage(scope, "gbuffer.thin_motion", f.gbuffer.motion, thin.spacing);
    }
    const uint32_t steps = h.stochasticRsm.step + h.valClustering.settling.step + h.laterBounces.step;
    const uint64_t light = combineHash(f.rsm.inputsVersion, scene.scene->instancesVersion);
    f.indirect = addDenoiser(scope, scene, thin, {f.indirect, light, steps}, s.denoiser, h.denoiser);
    f.indirect = addUpsampling(scope, f.gbuffer, thin, f.indirect);
    f.bounce1 =
        goesOn ? addUpsampling(scope, f.gbuffer, thin, f.bounce1, kFirstBounceUpsampling) : f.indirect;

    // Direct light
    f.shadows = addSunShadows(scope, scene, s.shadowMaps, h.sunShadows);
    f.direct = addSunLighting(scope, scene, f.gbuffer, f.shadows);
    const LightClusters& lamps =
        clusterLamps(*scene.scene, h.lampRelevance, s.lightClusters, h.lightClusters);
    f.lampShadows = addLampShadows(scope, scene, lamps, s.lightClusters.most, s.lampShadows, h.lampShadows);
    f.lampLists = addLampLists(scope, scene, f.gbuffer, lamps, s.lampLighting.tiles, h.lampLists);
    f.direct = addLampLighting(scope, scene, f.gbuffer, f.lampLists, f.lampShadows, f.direct, s.lampLighting);
    if (s.lightClusters.strongFirst) addLampRelevance(scope, f.viewPoints, f.lampLists, h.lampRelevance);

    // To the rules of a game
    addProbes(scope, scene, f.rsm, f.vals, f.isms, s.probes, h.probes);

    // To the eye
    f.outputs = addComposite(scope, f.gbuffer, f.direct, f.indirect, f.coat, s.composite);
    return f;
}

}  // namespace ag::gi
