#include "gi/gloss_rays.h"

#include <algorithm>
#include <utility>

#include "engine/core/hash.h"
#include "gi/blue_noise.h"
#include "gi/gather_grid.h"
#include "gi/occluder_trees.h"
#include "gi/pixel_rays.h"
#include "gi/ray_filter.h"
#include "gi/texel_rays.h"
#include "shaders/bvh/bvh_io.h"
#include "shaders/gloss_rays/gloss_rays_io.h"

namespace ag::gi {
namespace {

constexpr VkFormat kHalf4 = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr float kTrustedFrames = 64;    // from then on nothing is left of area lights' gloss
constexpr float kFading = 7.0f / 8;     // of a correction, a frame in which no rays are cast
constexpr uint32_t kFadingFrames = 64;  // then nothing is left
constexpr RayMeanNames kMeans = {
    "gloss_rays.accumulate",
    "gloss_rays.mean",
    "gloss_rays.square",
    "gloss_rays.surface",
    "gloss_rays.rest",
    "gloss_rays.cameras",
    {"gloss_rays.even",
     "gloss_rays.odd",
     {"gloss_rays.filter0", "gloss_rays.filter1", "gloss_rays.filter2", "gloss_rays.filter3"}}};
constexpr UpsamplingNames kToPixels = {
    "gloss_rays.upsample",
    "gloss_rays.upsample_far",
    "gloss_rays.found",
    {"gloss_rays.lacking", "gloss_rays.none_lacking", "gloss_rays.lacking_groups",
     "gloss_rays.no_lacking_groups"},
    {"gloss_rays.alone", "gloss_rays.none_alone", "gloss_rays.alone_groups", "gloss_rays.no_alone_groups"},
    "",
    "gloss_rays.place"};

// What this frame's rays found at the pixels of `gathered`.
ImageHandle addRays(GraphScope scope, const Surfaces& gathered, const GlossRaysInputs& in, uint32_t step) {
    const ImageHandle sent =
        scope.image("gloss_rays.sent", {.format = VK_FORMAT_R32G32B32A32_SFLOAT, .size = gathered.size});
    const BufferHandle noise = addBlueNoise(scope);
    const float snapping = in.occluders.trees.snapping;
    PassBuilder cast = scope.compute("gloss_rays.cast", "gloss_rays/cast.comp");
    cast.sample("normalMap", gathered.normal)
        .sample("depthMap", gathered.depth)
        .sample("reflectanceMap", gathered.reflectance)
        .read("camera", gathered.camera)
        .read("faces", in.rsm.faces)
        .read("slotOfTexel", in.clusters.slotOfTexel)
        .read("noise", noise)
        .read("lights", in.others.rows ? in.others.rows : in.occluders.trees.triangles)  // unread without
        .read("skyTexels", in.sky ? in.sky.texels : in.rsm.texels)                       // compiled out
        .read("skyUpTo", in.sky ? in.sky.upTo : noise)
        .constant("kSky", bool(in.sky))
        .constant("kBounces", in.firstLater < in.clusters.count)
        .constant("kEndless", in.endless)
        .write("sent", sent)
        .push(io::GlossCastPush{.atlasWidth = in.rsm.atlas.size.x,
                                .mapCount = in.rsm.lightRsmCount,
                                .valCount = in.clusters.count,
                                .firstLater = in.firstLater,
                                .lightCount = in.others.count,
                                .step = step,
                                .shift = blueNoiseShift(step),
                                .offset = in.occluders.rayOffset,
                                .pixelOffset = snapping / float(gathered.spacing),
                                .texelOffset = snapping,
                                .reach = kRayReaches * in.occluders.extent,
                                .emissiveArea = in.occluders.emissivePointArea,
                                .laterReach = reachOfPoints(in.occluders.bouncePointArea, in.nearReach)})
        .step(step)
        .dispatchThreads(gathered.size.x, gathered.size.y);
    readRsmTexels(cast, in.rsm);
    readMembers(cast, in.members);
    readTrees(cast, in.occluders.trees);
    return sent;
}

struct Mix {
    ImageHandle found{};   // invalid: no rays are cast
    float trust = 0;       // in that, at most
    float fading = 1;      // share of what was found before the last change that stays
    bool begins = false;   // with what the frame before ended with
    uint32_t spacing = 1;  // of pixels with rays, in these
    uint32_t step = 0;
};

ImageHandle addMix(GraphScope scope, const Surfaces& surfaces, const GlossRaysInputs& in,
                   const FollowedCamera& before, const Mix& mix) {
    const ImageInfo info{.format = kHalf4, .size = surfaces.size};
    const HistoryImage correction = scope.historyImage("gloss_rays.correction", info),
                       carried = scope.historyImage("gloss_rays.carried", info),
                       surface = scope.historyImage("gloss_rays.all_surfaces", info);
    const HistoryImage& known = mix.begins ? correction : carried;
    const ImageHandle gloss = scope.image("gloss_rays.gloss", info);
    const BufferHandle cameras =
        addReprojectionCameras(scope, "gloss_rays.all_cameras", surfaces.view, before.camera, surfaces.size);
    scope.compute("gloss_rays.mix", "gloss_rays/mix.comp")
        .sample("normalMap", surfaces.normal)
        .sample("depthMap", surfaces.depth)
        .sample("reflectanceMap", surfaces.reflectance)
        .sample("albedoMap", surfaces.albedo)
        .sample("irradianceMap", in.irradiance)
        .sample("glossMap", in.gloss)
        .sample("foundMap", mix.found ? mix.found : in.gloss)  // compiled out
        .samplePrevious("previousCarried", known, Sampler::kNearestClamp)
        .samplePrevious("previousSurface", surface, Sampler::kNearestClamp)
        .read("cameras", cameras)
        .write("gloss", gloss)
        .write("correction", correction.current)
        .write("carried", carried.current)
        .write("surface", surface.current)
        .constant("kRays", bool(mix.found))
        .push(io::GlossMixPush{pixelRays(surfaces.view, surfaces.size), surfaces.view.near,
                               before.known && known.valid && surface.valid, mix.trust, mix.fading,
                               int(mix.spacing) + 1})
        .step(mix.step)
        .dispatchThreads(surfaces.size.x, surfaces.size.y);
    return gloss;
}

}  // namespace

ImageHandle addGlossRays(GraphScope scope, const Surfaces& surfaces, const Surfaces& gathered,
                         const GlossRaysInputs& in, const GlossRaysSettings& s, GlossRaysHistory& h) {
    if (!s.enabled || !in.gloss || !in.irradiance) return in.gloss;
    const GatherGrid& grid = in.grid;
    const uint32_t step = h.settling.advance(combineHash(grid.turn, grid.change), grid.frames);
    const bool known = std::exchange(h.originVersion, in.world.versions.origin) == in.world.versions.origin;
    const FollowedCamera before = followCamera(surfaces.view, h.camera, known),
                         gatheredBefore =
                             followCamera(gathered.view, h.gatheredCamera, known && h.sinceRays == 0);
    h.sinceRays = grid.still ? 0 : std::min(h.sinceRays, kFadingFrames) + 1;
    if (h.sinceRays > kFadingFrames) return in.gloss;
    if (!grid.still)
        return addMix(scope, surfaces, in, before, {.fading = kFading, .begins = true, .step = step});

    Surfaces at = gathered;
    at.reflectance =
        gathered.spacing == surfaces.spacing
            ? surfaces.reflectance
            : addDownsampledImage(scope, "gloss_rays.downsample_reflectance", surfaces.reflectance,
                                  {gathered.spacing / surfaces.spacing, gathered.place});
    RayMeans means{.sent = addRays(scope, at, in, rayNumber(grid, h.settling)),
                   .before = gatheredBefore,
                   .mostLength = meanLength(grid, s.mostLength),
                   .moving = false,
                   .step = step,
                   .filter = {s.rounds, s.tolerance}};
    if (grid.begins && grid.turn > 0) means.mostLength = kOfNeighbours;
    const ImageHandle mean = addRayMeans(scope, at, means, kMeans);
    const ImageHandle found = addTurn(scope, surfaces, at, mean, grid.turn, means.filter,
                                      {kToPixels, {"gloss_rays.join", "gloss_rays.joined"}});
    const float trusted = std::clamp(float(grid.frames), 1.0f, kTrustedFrames);
    const float trust = grid.turn > 0 ? 1 : std::min(float(h.settling.sinceChange) / trusted, 1.0f);
    return addMix(scope, surfaces, in, before,
                  {found, trust, keptShare(grid), h.settling.sinceChange == 0,
                   gathered.spacing / surfaces.spacing, step});
}

}  // namespace ag::gi
