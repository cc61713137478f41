#include "gi/surface_emitters.h"

#include <bit>
#include <cmath>

#include "engine/core/hash.h"
#include "gi/later_bounces.h"
#include "gi/rsm_views.h"
#include "gi/surface_points.h"
#include "shaders/rsm/rsm_io.h"

namespace ag::gi {
namespace {

uint32_t sideOf(uint32_t count) {
    return uint32_t(std::lround(std::sqrt(double(count))));
}

bool anyLight(const World& world, const Occluders& occluders) {
    for (const RsmLight& light : world.lights)
        if (light.intensity != glm::vec3(0)) return true;
    return occluders.emissiveFlux > 0;
}

float fluxOf(std::span<const RsmLight> lights, const Bounds& bounds) {
    float sum = 0;
    for (const RsmLight& light : lights)
        sum += emittedFlux(light, bounds);
    return sum;
}

}  // namespace

SurfaceEmitters addSurfaceEmitters(GraphScope scope, const World& world, const Occluders& occluders,
                                   uint64_t skyStep, const LaterBouncesSettings& s, Settling& settling) {
    SurfaceEmitters e;
    const Versions& versions = world.versions;
    const float others = fluxOf(world.otherLights, world.bounds);
    if (occluders.bouncePoints && s.enabled && (skyStep != 0 || others > 0 || anyLight(world, occluders))) {
        e.reflecting.side = sideOf(occluders.bouncePointCount);
        e.reflectingShare = s.share;
        e.otherFlux = others;
    }
    if (occluders.bouncePoints && occluders.emissiveFlux > 0)
        e.emissive.side = sideOf(occluders.emissivePointCount), e.emissiveFlux = occluders.emissiveFlux;
    const uint32_t count = e.reflecting.count() + e.emissive.count();
    if (count == 0) return {};
    e.emissive.firstPoint = e.reflecting.count();
    const VkFormat vec4 = VK_FORMAT_R32G32B32A32_SFLOAT;
    const uint32_t reflecting = e.reflecting.count();
    uint32_t step = 0;
    if (reflecting > 0) {
        const uint64_t inputs =
            combineHash(combineHash(combineHash(versions.lights, skyStep), versions.instances),
                        combineHash(versions.camera, hashValue(glm::vec3(s.share, s.feedback, s.rays))));
        step = scope.isHeld() ? settling.step : settling.advance(inputs, s.settleFrames);
        e.irradiance = scope.historyBuffer(
            "later_bounces.irradiance", {.sizeBytes = reflecting * sizeof(glm::vec4), .texelFormat = vec4});
    }
    e.texels = scope.buffer("surface_emitters.texels",
                            {.sizeBytes = count * sizeof(io::RsmTexel), .texelFormat = vec4});
    e.edges = scope.buffer("surface_emitters.edges", {.sizeBytes = count * 2 * sizeof(io::SurfaceEdge)});
    PassBuilder emit = scope.compute("surface_emitters.emit", occluders.deformedPositions
                                                                  ? "surface_emitters/emit_skinned.comp"
                                                                  : "surface_emitters/emit.comp");
    emit.read("instances", occluders.instances)
        .read("points", occluders.bouncePoints)
        .write("texels", e.texels)
        .write("edges", e.edges)
        .push(io::EmitPush{.count = count,
                           .reflecting = reflecting,
                           .firstPoint = reflecting > 0 ? 0 : occluders.bouncePointCount,
                           .known = e.irradiance.valid})
        .key(versions.instances)
        .step(step)
        .dispatchThreads(count);
    if (reflecting > 0)
        emit.readPrevious("irradiance", e.irradiance);
    else
        emit.read("irradiance", e.texels);  // not looked at
    readDeformed(emit, occluders);
    return e;
}

}  // namespace ag::gi
