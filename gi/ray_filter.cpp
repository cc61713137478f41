#include "gi/ray_filter.h"

#include <algorithm>
#include <utility>

#include "gi/pixel_rays.h"
#include "shaders/ray_filter/ray_filter_io.h"

namespace ag::gi {
namespace {

constexpr VkFormat kMeanFormat = VK_FORMAT_R32G32B32A32_SFLOAT;

}  // namespace

ImageHandle addRayFilter(GraphScope scope, glm::uvec2 size, const UncertainLight& of, const RayFilter& filter,
                         const RayFilterNames& names, FilterAlpha alpha) {
    const ImageInfo info{.format = kMeanFormat, .size = size};
    const std::array<ImageHandle, 2> turns = {scope.image(names.even, info), scope.image(names.odd, info)};
    ImageHandle from = of.light;
    const uint32_t rounds = std::min(filter.rounds, kMostFilterRounds);
    for (uint32_t round = 0; round < rounds; ++round) {
        scope.compute(names.passes[round], "ray_filter/filter.comp")
            .sample("rest", from)
            .sample("surface", of.surface)
            .read("cameras", of.cameras)
            .write("result", turns[round % 2])
            .constant("kDeviation", alpha == FilterAlpha::kDeviation && round + 1 == rounds)
            .push(io::RayFilterPush{int(1u << round), filter.tolerance})
            .dispatchThreads(size.x, size.y);
        from = turns[round % 2];
    }
    return from;
}

FollowedCamera followCamera(const RenderCamera& now, RenderCamera& history, bool known) {
    const RenderCamera before = std::exchange(history, now);
    return {known ? before : now, known};
}

ImageHandle addRayMeans(GraphScope scope, const Surfaces& surfaces, const RayMeans& in,
                        const RayMeanNames& names) {
    const glm::uvec2 size = surfaces.size;
    const HistoryImage mean = scope.historyImage(names.mean, {.format = kMeanFormat, .size = size}),
                       square =
                           scope.historyImage(names.square, {.format = VK_FORMAT_R32_SFLOAT, .size = size}),
                       surface = scope.historyImage(names.surface,
                                                    {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = size});
    const ImageHandle rest = scope.image(names.rest, {.format = kMeanFormat, .size = size});
    const BufferHandle cameras =
        addReprojectionCameras(scope, names.cameras, surfaces.view, in.before.camera, size);
    scope.compute(names.pass, "ray_filter/accumulate.comp")
        .sample("normalMap", surfaces.normal)
        .sample("depthMap", surfaces.depth)
        .sample("sent", in.sent)
        .samplePrevious("previousMean", mean, Sampler::kNearestClamp)
        .samplePrevious("previousSquare", square, Sampler::kNearestClamp)
        .samplePrevious("previousSurface", surface, Sampler::kNearestClamp)
        .read("cameras", cameras)
        .write("meanOf", mean.current)
        .write("squareOf", square.current)
        .write("surface", surface.current)
        .write("rest", rest)
        .sample("motionMap", surfaces.motion ? surfaces.motion : surfaces.normal)
        .constant("kMotion", bool(surfaces.motion))
        .push(io::RayMeanPush{surfaces.view.near, in.before.known && mean.valid, in.mostLength, in.moving})
        .step(in.step)
        .dispatchThreads(size.x, size.y);
    return addRayFilter(scope, size, {rest, surface.current, cameras}, in.filter, names.filter,
                        FilterAlpha::kDeviation);
}

ImageHandle addJoinedTurns(GraphScope scope, const Surfaces& all, ImageHandle placed, float tolerance,
                           const JoinNames& names) {
    const ImageHandle result =
        scope.image(names.result, {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = all.size});
    scope.compute(names.pass, "ray_filter/join.comp")
        .sample("normalMap", all.normal)
        .sample("depthMap", all.depth)
        .sample("light", placed)
        .write("result", result)
        .push(io::JoinPush{pixelRays(all.view, all.size), all.view.near, {1, tolerance}})
        .dispatchThreads(all.size.x, all.size.y);
    return result;
}

ImageHandle addTurn(GraphScope scope, const Surfaces& all, const Surfaces& gathered, ImageHandle means,
                    uint32_t turn, const RayFilter& filter, const TurnNames& names) {
    if (turn == 0 || !hasAllPixels(scope, names.upsampling))
        return addUpsampling(scope, all, gathered, Irradiance{means}, names.upsampling).image;
    const ImageHandle placed = addPlacing(scope, all, gathered, Irradiance{means}, names.upsampling).image;
    return filter.rounds > 0 ? addJoinedTurns(scope, all, placed, filter.tolerance, names.join) : placed;
}

}  // namespace ag::gi
