#include "gi/later_bounces.h"

#include <algorithm>
#include <cmath>

#include "engine/core/hash.h"
#include "gi/surface_points.h"
#include "gi/upsampling.h"
#include "gi/val_shading.h"
#include "shaders/rsm/rsm_io.h"
#include "shaders/val_shading/val_shading_io.h"

namespace ag::gi {
namespace {

// As ValShadingSettings'. Farther than on screen: what disks are off by comes back in every bounce.
constexpr float kNearReach = 6;

}  // namespace

LaterLight addLaterLight(GraphScope scope, const Occluders& occluders, const Versions& versions,
                         const LaterBouncesSettings& s, Settling& settling) {
    if (!s.enabled || occluders.bouncePointCount == 0) return {};
    const VkFormat vec4 = VK_FORMAT_R32G32B32A32_SFLOAT;
    const uint64_t inputs =
        combineHash(combineHash(versions.lights, versions.instances),
                    combineHash(versions.camera, hashValue(glm::vec2(s.share, s.feedback))));
    const uint32_t step = scope.isHeld() ? settling.step : settling.advance(inputs, s.settleFrames);
    LaterLight light{.count = occluders.bouncePointCount, .share = s.share};
    light.side = uint32_t(std::lround(std::sqrt(double(light.count))));
    light.irradiance = scope.historyBuffer(
        "later_bounces.irradiance", {.sizeBytes = light.count * sizeof(glm::vec4), .texelFormat = vec4});
    light.texels = scope.buffer("later_bounces.texels",
                                {.sizeBytes = light.count * sizeof(io::RsmTexel), .texelFormat = vec4});
    light.edges =
        scope.buffer("later_bounces.edges", {.sizeBytes = light.count * 2 * sizeof(io::SurfaceEdge)});
    PassBuilder emit =
        scope.compute("later_bounces.emit", occluders.deformedPositions ? "later_bounces/emit_skinned.comp"
                                                                        : "later_bounces/emit.comp");
    emit.read("instances", occluders.instances)
        .read("points", occluders.bouncePoints)
        .readPrevious("irradiance", light.irradiance)
        .write("texels", light.texels)
        .write("edges", light.edges)
        .push(io::EmitPush{.count = light.count, .known = light.irradiance.valid})
        .key(versions.instances)
        .step(step)
        .dispatchThreads(light.count);
    readDeformed(emit, occluders);
    return light;
}

void addLaterIrradiance(GraphScope scope, const LaterLight& light, const ShadowedVals& lights,
                        uint32_t firstLater, const LaterBouncesSettings& s) {
    const Vals& vals = lights.vals;
    const IsmAtlas& isms = lights.isms;
    if (!light.texels || vals.count == 0) return;
    const ValShadingSettings shading;
    const uint32_t runs = (light.count + io::kRunPoints - 1) / io::kRunPoints;
    const io::GatherPush push{.count = light.count,
                              .valCount = s.feedback ? vals.count : std::min(vals.count, firstLater),
                              .nearReach = kNearReach,
                              .ismTileSize = isms.tileSize};
    const BufferHandle counts = scope.buffer("later_bounces.counts", {.sizeBytes = runs * 8ull});
    const BufferHandle lists = scope.buffer(
        "later_bounces.lists",
        {.sizeBytes = uint64_t(runs) * io::kLightLists * vals.count * 4, .texelFormat = VK_FORMAT_R32_UINT});
    scope.compute("later_bounces.classify", "later_bounces/classify.comp")
        .read("texels", light.texels)
        .read("vals", vals.vals)
        .read("shapes", vals.shapes)
        .write("lists", lists)
        .write("counts", counts)
        .push(push)
        .dispatchGroups(runs);
    const auto gather = [&](std::string_view name, uint32_t list, ValShape shape) {
        PassBuilder pass = scope.compute(name, "later_bounces/gather.comp");
        pass.read("texels", light.texels)
            .read("vals", vals.vals)
            .read("shapes", vals.shapes)
            .read("isms", isms.planes ? isms.planes : vals.vals)
            .read("lists", lists)
            .read("counts", counts)
            .constant("kShape", uint32_t(shape))
            .constant("kVisibilityTaps", isms.planes ? 1 : 0)
            .constant("kList", list)
            .constant("kParaboloid", isms.mapping == IsmMapping::kParaboloid)
            .push(push)
            .dispatchGroups(runs);
        return pass;
    };
    gather("later_bounces.far", io::kFarList, shading.farShape).write("irradiance", light.irradiance.current);
    gather("later_bounces.near", io::kNearList, shading.shape)
        .constant("kAdd", true)
        .readWrite("irradiance", light.irradiance.current);
    scope.output(light.irradiance.current);
}

Irradiance addLaterShading(GraphScope scope, const Surfaces& gbuffer, const Irradiance& bounce1,
                           const ShadowedVals& lights, const LaterShading& later,
                           const ValShadingSettings& shading) {
    if (later.spacing == 1) return addValShading(scope, gbuffer, lights, shading, kAllBouncesShading);
    const Surfaces downsampled = addDownsampled(scope, gbuffer, later.spacing, kLaterDownsampling);
    const ShadowedVals laterLights{laterVals(lights.vals, later.firstLater), lights.isms};
    const Irradiance added = addValShading(scope, downsampled, laterLights, shading, kLaterShading);
    return addUpsampling(scope, gbuffer, downsampled, added, kLaterUpsampling, bounce1);
}

}  // namespace ag::gi
