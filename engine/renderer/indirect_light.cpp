#include "engine/renderer/indirect_light.h"

#include "engine/renderer/rsm_draws.h"
#include "engine/renderer/ssvp_draws.h"
#include "gi/published/published.h"

namespace ag::render {
namespace {

gi::RsmLight rsmLightOf(const RenderLight& light) {
    return {.kind = light.kind,
            .position = light.position,
            .direction = light.direction,
            .intensity = light.intensity,
            .range = light.range,
            .innerConeAngle = light.innerConeAngle,
            .outerConeAngle = light.outerConeAngle,
            .resolution = light.rsmResolution,
            .budgetShare = light.budgetShare,
            .id = light.id};
}

gi::MovedThing ballRound(uint32_t row, const Bounds& b) {
    return {row, 0.5f * (b.min + b.max), 0.5f * glm::length(b.max - b.min)};
}

void listMoved(const SceneView& scene, std::vector<gi::MovedThing>& moved) {
    moved.clear();
    if (scene.replaced) return;
    uint32_t count = 0;
    for (const RenderScene::Range& range : scene.moved)
        count += range.end - range.begin;
    if (count > gi::kMostMovedThings) return;
    for (const RenderScene::Range& range : scene.moved)
        for (uint32_t row = range.begin; row < range.end; ++row)
            moved.push_back(ballRound(row, scene.draws->boundsOf(row)));
}

}  // namespace

gi::Occluders occludersOf(const SceneView& scene) {
    gi::Occluders o = scene.points;
    o.instances = scene.instances;
    o.deformedPositions = scene.skin.deformedPositions;
    o.deformedAttributes = scene.skin.deformedAttributes;
    o.trees = scene.trees;
    o.staticVersion = scene.staticVersion;
    o.extent = scene.extent;
    o.rayOffset = gi::rayOffset(scene.scene->bounds, scene.extent);
    return o;
}

namespace {

gi::BounceLight addRecipe(GraphScope scope, const SceneView& scene, const gi::BounceLightInputs& in,
                          const RenderSettings& s, gi::BounceLightHistory& h) {
    switch (s.technique) {
        case Technique::kNone:
            h.probes.readings.clear();
            return {};
        case Technique::kAreaLights:
            return gi::addBounceLight(scope, in, s.bounce, h);
        case Technique::kStochastic:
            return gi::addStochasticLight(scope, in, s.bounce, h);
        case Technique::kRsmBrute:
            return gi::addRsmBrute(scope, in, s.bounce, h);
        case Technique::kRsm400:
            return gi::addRsm400(scope, in, s.bounce, h);
        case Technique::kIrsm:
            return gi::addIrsm(scope, in, s.bounce, h);
        case Technique::kIsm:
            return gi::addIsm(scope, in, s.bounce, s.interleavedShading, h);
        case Technique::kRsmc:
            return gi::addRsmc(scope, in, s.bounce, h);
        case Technique::kAcrsm:
            return gi::addAcrsm(scope, in, s.bounce, s.interleavedShading, h);
        case Technique::kSsvp:
            break;
    }
    const auto draw = [&](GraphScope at, const gi::Paraboloids& maps) { drawParaboloids(at, scene, maps); };
    return gi::addSsvpLight(scope, in, s.bounce, s.ssvp, draw, h);
}

}  // namespace

bool needsMotion(const RenderSettings& s, bool sky) {
    if (s.antialiasing.mode == Antialiasing::kTemporal) return true;
    if (sky && s.bounce.sky.enabled) return true;
    if (s.technique == Technique::kNone) return false;
    return s.bounce.denoiser.enabled && s.bounce.denoiser.motion;
}

gi::Versions versionsOf(const SceneView& scene) {
    const RenderScene& s = *scene.scene;
    return {.scene = scene.loadedVersion,
            .instances = s.instancesVersion,
            .lights = s.lightsVersion,
            .camera = jitteredVersion(s.cameraVersion, scene.grid),
            .view = s.cameraVersion,
            .origin = s.originVersion};
}

gi::World worldOf(const SceneView& scene, WorldLists& lists) {
    const RenderScene& s = *scene.scene;
    lists.lights.clear();
    lists.otherLights.clear();
    for (const RenderLight& light : s.lights)
        if (light.bounces)
            lists.lights.push_back(rsmLightOf(light));
        else if (light.reflects)
            lists.otherLights.push_back(rsmLightOf(light));
    listMoved(scene, lists.moved);
    const bool empty = s.instances.empty();
    return {.lights = lists.lights,
            .otherLights = lists.otherLights,
            .bounds = empty ? Bounds{} : s.bounds,
            .versions = versionsOf(scene),
            .moved = lists.moved,
            .extent = scene.extent};
}

gi::BounceLight addIndirectLight(GraphScope scope, const SceneView& scene, const gi::Surfaces& surfaces,
                                 const RenderSettings& s, RenderHistory& h) {
    if (std::exchange(h.technique, s.technique) != s.technique) h.bounce.refresh = {};
    const auto draw = [&](GraphScope at, gi::RsmSet& rsm) { drawRsm(at, scene, rsm); };
    const gi::BounceLightInputs in{.surfaces = surfaces,
                                   .world = worldOf(scene, h.world),
                                   .occluders = occludersOf(scene),
                                   .sky = scene.sky,
                                   .drawRsm = draw,
                                   .probes = scene.scene->probes,
                                   .lightUnit = scene.units.light};
    // Beside direct light, where the device has a queue for that.
    gi::BounceLight light = addRecipe(scope.async(), scene, in, s, h.bounce);
    if (!light.viewPoints) light.viewPoints = gi::addViewPoints(scope, surfaces);
    return light;
}

}  // namespace ag::render
