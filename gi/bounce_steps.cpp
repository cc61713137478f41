#include "gi/bounce_steps.h"

#include "engine/core/hash.h"
#include "gi/upsampling.h"

namespace ag::gi {

uint64_t stepOfSky(const BounceLightInputs& in, const SkySettings& s, const Settling& onPoints) {
    return in.sky && s.enabled ? combineHash(in.sky.version, onPoints.step + 1) : 0;
}

void addRsms(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& s,
             BounceLightHistory& h, BounceLight& f) {
    f.rsm = planRsm(scope, in.world, s.rsm, s.valClustering.count, f.emitters, h.clusterShares);
    if (f.rsm.empty()) return;
    in.drawRsm(scope, f.rsm);
    addRsmTexels(scope, f.rsm, f.emitters);
}

void addAreaLights(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& s,
                   BounceLightHistory& h, BounceLight& f) {
    addRsms(scope, in, s, h, f);
    f.importance = addImportance(scope, f.rsm, f.viewPoints, s.importance);
    f.clusters = addValClustering(scope, f.rsm, f.importance, s.valClustering, in.world.versions.camera,
                                  h.valClustering);
    f.vals = addValFit(scope, f.rsm, f.emitters, f.clusters,
                       s.ismAtlas.traced && in.occluders.trees ? &in.occluders : nullptr);
}

void addVisibility(GraphScope scope, const BounceLightInputs& in, const IsmAtlasSettings& s, BounceLight& f) {
    if (f.vals.count == 0 || !s.enabled) return;
    f.surfacePoints = addSurfacePoints(scope, in.occluders, in.world.versions.instances);
    f.isms = addIsmAtlas(scope, f.surfacePoints, in.occluders.trees, f.vals, s);
}

GatherGrid gatherGridOf(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& s,
                        BounceLightHistory& h, const BounceLight& f) {
    const Versions& v = in.world.versions;
    uint64_t light = f.rsm.inputsVersion;
    // Nobody may have asked for the light yet: then the pixels of earlier turns have none.
    const uint64_t wanted =
        hasAllPixels(scope, kUpsampling) + 2 * hasAllPixels(scope, kFirstBounceUpsampling);
    for (const uint64_t part : {v.scene, v.instances, v.lights, v.camera, v.origin, in.sky.version,
                                in.occluders.trees.staticVersion, hashValue(in.surfaces.size), wanted})
        light = combineHash(light, part);
    return chooseGatherGrid(light, f.firstCount > 0 && castsTexelRays(s.texelRays, in.occluders), s,
                            h.gatherGrid);
}

void addToPixels(GraphScope scope, const BounceLightInputs& in, const Surfaces& gathered,
                 const BounceLightSettings& s, BounceLightHistory& h, BounceLight& f,
                 const GatherGrid& grid) {
    const bool goesOn = f.irradiance.image != f.bounce1.image;
    const uint32_t steps = h.stochasticRsm.step + h.valClustering.settling.step + h.laterBounces.step;
    const uint64_t light = combineHash(f.rsm.inputsVersion, in.world.versions.instances);
    if (grid.turn > 0 && grid.begins) forgetPixels(scope);
    f.irradiance = addDenoiser(scope, gathered, in.world.versions.origin, {f.irradiance, light, steps},
                               s.denoiser, h.denoiser);
    // Pixels meet area lights, not points that share maps.
    const bool areas = s.valShading.shape != ValShape::kPoint && !f.isms.shared;
    const Vals vals = areas ? f.vals : Vals{};
    const LightsOfPixels all{{vals, f.isms}, s.valShading.taps},
        first{{firstVals(vals, f.firstCount), f.isms}, s.valShading.taps};
    const auto toPixels = [&](const Irradiance& made, const UpsamplingNames& names,
                              const LightsOfPixels& of) {
        return grid.turn > 0 && hasAllPixels(scope, names)
                   ? addPlacing(scope, in.surfaces, gathered, made, names)
                   : addUpsampling(scope, in.surfaces, gathered, made, names, of);
    };
    f.irradiance = toPixels(f.irradiance, kUpsampling, all);
    f.bounce1 = goesOn ? toPixels(f.bounce1, kFirstBounceUpsampling, first) : f.irradiance;
}

}  // namespace ag::gi
