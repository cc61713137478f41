#include "gi/bounce_steps.h"

#include <algorithm>

#include "engine/core/hash.h"
#include "gi/ray_filter.h"
#include "gi/texel_rays.h"
#include "gi/upsampling.h"

namespace ag::gi {

uint64_t stepOfSky(const BounceLightInputs& in, const SkySettings& s, const Settling& onPoints) {
    return in.sky && s.enabled ? combineHash(in.sky.version, onPoints.step + 1) : 0;
}

SunFocus addSunFocus(GraphScope scope, const BounceLightInputs& in, const RsmSettings& s,
                     BufferHandle viewPoints, BounceLightHistory& h) {
    constexpr std::array<std::string_view, kFramesInFlight> kCopies = {"rsm.view_points0",
                                                                       "rsm.view_points1"};
    const bool sun = std::ranges::any_of(
        in.world.lights, [](const RsmLight& light) { return light.kind == LightKind::kDirectional; });
    if (sun && s.sunDetail > 0)
        return followFocus(scope.readBack(kCopies, viewPoints), in.surfaces.view.position, h.sunFocus);
    h.sunFocus = {};
    return {};
}

void addRsms(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& s,
             BounceLightHistory& h, BounceLight& f) {
    f.rsm = planRsm(scope, in.world, s.rsm, s.valClustering.count, f.emitters, f.sunFocus, h.rsm);
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

Vals valsOf(const BounceLight& f, Term term) {
    const uint32_t bounces = f.rsm.emissiveCount, later = f.firstCount;
    switch (term) {
        case Term::kAll:
            return f.vals;
        case Term::kBounces:
            return valsBetween(f.vals, bounces, ~0u);
        case Term::kFirstBounce:
            return valsBetween(f.vals, bounces, later);
        case Term::kLaterBounces:
            return valsBetween(f.vals, later, ~0u);
        case Term::kEmissive:
            return valsBetween(f.vals, 0, bounces);
    }
    return {};
}

bool isFirstBounce(const BounceLight& f, const Vals& vals) {
    const Vals first = valsOf(f, Term::kFirstBounce);
    return vals.first == first.first && vals.count == first.count;
}

GatherGrid gatherGridOf(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& s,
                        BounceLightHistory& h, const BounceLight& f) {
    const Versions& v = in.world.versions;
    uint64_t light = f.rsm.inputsVersion;
    // Nobody may have asked for the light yet: then the pixels of earlier turns have none.
    const uint64_t wanted = hasAllPixels(scope, kUpsampling) + 2 * scope.wasWanted("gloss_rays.mix");
    for (const uint64_t part : {v.scene, v.instances, v.lights, v.view, v.origin, in.sky.version,
                                in.occluders.trees.staticVersion, hashValue(in.surfaces.size), wanted})
        light = combineHash(light, part);
    BounceLightSettings waitsFor = s;
    if (!in.sky || !s.sky.enabled) waitsFor.sky.settleFrames = 0;
    return chooseGatherGrid(light, v.camera,
                            !valsOf(f, s.term).empty() && castsTexelRays(s.texelRays, in.occluders), waitsFor,
                            h.gatherGrid);
}

void addToPixels(GraphScope scope, const BounceLightInputs& in, const Surfaces& gathered,
                 const BounceLightSettings& s, BounceLightHistory& h, BounceLight& f,
                 const GatherGrid& grid) {
    const bool apart = f.bounce1.image && f.irradiance.image != f.bounce1.image;
    const uint32_t steps = h.stochasticRsm.step + h.valClustering.settling.step + h.laterBounces.step;
    const uint64_t light = combineHash(f.rsm.inputsVersion, in.world.versions.instances);
    if (grid.turn > 0 && grid.begins) forgetPixels(scope);
    f.irradiance = addDenoiser(scope, gathered, in.world.versions.origin, {f.irradiance, light, steps},
                               s.denoiser, h.denoiser);
    // Pixels meet area lights, not points that share maps.
    const bool areas = s.valShading.shape != ValShape::kPoint && !f.isms.shared;
    const auto lightsOf = [&](Term term) {
        return LightsOfPixels{{areas ? valsOf(f, term) : Vals{}, f.isms}, s.valShading.taps};
    };
    const auto toPixels = [&](const Irradiance& made, const UpsamplingNames& names,
                              const LightsOfPixels& of) {
        return grid.turn > 0 && hasAllPixels(scope, names)
                   ? addPlacing(scope, in.surfaces, gathered, made, names)
                   : addUpsampling(scope, in.surfaces, gathered, made, names, of);
    };
    const bool first = f.bounce1.image && !apart;
    f.irradiance = toPixels(f.irradiance, kUpsampling, lightsOf(f.term));
    if (grid.turn > 0 && s.texelRays.rounds > 0 && !s.denoiser.enabled)
        f.irradiance.image = addJoinedTurns(scope, in.surfaces, f.irradiance.image, s.texelRays.tolerance,
                                            {"texel_rays.join", "texel_rays.joined"});
    if (apart) f.bounce1 = toPixels(f.bounce1, kFirstBounceUpsampling, lightsOf(Term::kFirstBounce));
    if (first) f.bounce1 = f.irradiance;
}

}  // namespace ag::gi
