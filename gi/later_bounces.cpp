#include "gi/later_bounces.h"

#include <algorithm>

#include "gi/upsampling.h"
#include "gi/val_shading.h"
#include "gi/val_tiles.h"
#include "shaders/val_shading/val_shading_io.h"

namespace ag::gi {
namespace {

// As ValShadingSettings'. Farther than on screen: what disks are off by comes back in every bounce.
constexpr float kNearReach = 6;

}  // namespace

void addLaterIrradiance(GraphScope scope, const SurfaceEmitters& emitters, const StraightLight& straight,
                        const ShadowedVals& lights, uint32_t firstLater, const LaterBouncesSettings& s) {
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
            .read("sky", straight.sky ? straight.sky : vals.vals)
            .constant("kSky", bool(straight.sky) && list == io::kFarList)
            .read("straight", straight.lights ? straight.lights : vals.vals)
            .constant("kStraight", bool(straight.lights) && list == io::kFarList)
            .push(push)
            .dispatchGroups(runs);
        return pass;
    };
    gather("later_bounces.far", io::kFarList, shading.farShape)
        .write("irradiance", emitters.irradiance.current);
    gather("later_bounces.near", io::kNearList, shading.shape)
        .constant("kAdd", true)
        .readWrite("irradiance", emitters.irradiance.current);
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
