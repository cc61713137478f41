#include "gi/later_bounces.h"

#include <algorithm>

#include "gi/blue_noise.h"
#include "gi/occluder_trees.h"
#include "gi/texel_rays.h"
#include "gi/upsampling.h"
#include "gi/val_shading.h"
#include "gi/val_tiles.h"
#include "shaders/bvh/bvh_io.h"
#include "shaders/val_shading/val_shading_io.h"

namespace ag::gi {
namespace {

// As ValShadingSettings'. Farther than on screen: what disks are off by comes back in every bounce.
constexpr float kNearReach = 6;
constexpr uint32_t kMovingLength = 16, kStillLength = 1024;  // frames that means of rays stand for
constexpr uint32_t kLeastLength = 4;                         // in which a point has rays

void addPointRays(GraphScope scope, const SurfaceEmitters& emitters, uint32_t lightCount, uint32_t firstLater,
                  const PointRays& in, const LaterBouncesSettings& s) {
    const uint32_t count = emitters.reflecting.count();
    const HistoryBuffer means =
        scope.historyBuffer("later_bounces.point_means", {.sizeBytes = count * sizeof(io::PointMeans)});
    const BufferHandle noSky = addBlueNoise(scope);  // in its place, compiled out
    PassBuilder trace = scope.compute("later_bounces.trace", "later_bounces/trace.comp");
    trace.read("points", emitters.texels)
        .readWrite("irradiance", emitters.irradiance.current)
        .readPrevious("before", means)
        .write("means", means.current)
        .push(io::TracePush{
            .count = count,
            .valCount = lightCount,
            .firstLater = firstLater,
            .rays = in.still ? s.rays : 1,
            .step = in.step,
            .turns = s.turns,
            .valid = means.valid,
            .mostLength = float(std::max((in.still ? kStillLength : kMovingLength) / s.turns, kLeastLength)),
            .offset = in.occluders.rayOffset,
            .texelOffset = in.occluders.trees.snapping,
            .atlasWidth = in.rsm.atlas.size.x,
            .nearReach = reachOfPoints(in.occluders.bouncePointArea, in.reach)})
        .read("skyTexels", in.sky ? in.sky.texels : in.rsm.texels)
        .read("skyUpTo", in.sky ? in.sky.upTo : noSky)
        .constant("kSky", bool(in.sky))
        .step(in.step)
        .dispatchThreads(count);
    readRsmTexels(trace, in.rsm);
    readMembers(trace, in.members);
    readTrees(trace, in.occluders.trees);
}

}  // namespace

void addLaterIrradiance(GraphScope scope, const SurfaceEmitters& emitters, const StraightLight& straight,
                        const ShadowedVals& lights, uint32_t firstLater, const LaterBouncesSettings& s,
                        const PointRays* rays) {
    const auto& [vals, isms] = lights;
    const uint32_t count = emitters.reflecting.count();
    if (count == 0 || vals.count == 0) return;
    const ValShadingSettings shading;
    const uint32_t runs = (count + io::kRunPoints - 1) / io::kRunPoints;
    const io::GatherPush push{.count = count,
                              .valCount = s.feedback ? vals.count : std::min(vals.count, firstLater),
                              .nearReach = kNearReach,
                              .ismTileSize = isms.tileSize};
    const BufferHandle counts = scope.buffer("later_bounces.counts", {.sizeBytes = runs * 8ull});
    const BufferHandle lists = scope.buffer(
        "later_bounces.lists",
        {.sizeBytes = uint64_t(runs) * io::kLightLists * vals.count * 4, .texelFormat = VK_FORMAT_R32_UINT});
    scope.compute("later_bounces.classify", "later_bounces/classify.comp")
        .read("texels", emitters.texels)
        .read("vals", vals.vals)
        .read("shapes", vals.shapes)
        .write("lists", lists)
        .write("counts", counts)
        .push(push)
        .dispatchGroups(runs);
    const auto gather = [&](std::string_view name, uint32_t list, ValShape shape) {
        PassBuilder pass = scope.compute(name, "later_bounces/gather.comp");
        readLights(pass, lights, shape, 1);
        pass.read("texels", emitters.texels)
            .read("lists", lists)
            .read("counts", counts)
            .constant("kList", list)
            .push(push)
            .dispatchGroups(runs);
        return pass;
    };
    gather("later_bounces.far", io::kFarList, shading.farShape)
        .write("irradiance", emitters.irradiance.current);
    gather("later_bounces.near", io::kNearList, shading.shape)
        .constant("kAdd", true)
        .readWrite("irradiance", emitters.irradiance.current);
    if (rays && s.rays > 0)
        addPointRays(scope, emitters, std::min(push.valCount, rays->clusterCount), firstLater, *rays, s);
    scope.compute("later_bounces.conserve", "later_bounces/conserve.comp")
        .read("texels", emitters.texels)
        .read("vals", vals.vals)
        .read("sky", straight.sky ? straight.sky : vals.vals)
        .constant("kSky", bool(straight.sky))
        .read("straight", straight.lights ? straight.lights : vals.vals)
        .constant("kStraight", bool(straight.lights))
        .readWrite("irradiance", emitters.irradiance.current)
        .push(push)
        .dispatchGroups(1);
    scope.output(emitters.irradiance.current);
}

Irradiance addLaterShading(GraphScope scope, const Surfaces& gbuffer, const Irradiance& others,
                           const ShadowedVals& lights, uint32_t spacing, const ValShadingSettings& shading) {
    if (lights.vals.empty()) return others;
    const Surfaces downsampled = addDownsampled(scope, gbuffer, spacing, kLaterDownsampling);
    const Irradiance added = addValShading(scope, downsampled, lights, shading, kLaterShading);
    return addUpsampling(scope, gbuffer, downsampled, added, kLaterUpsampling, others);
}

}  // namespace ag::gi
