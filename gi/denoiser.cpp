#include "gi/denoiser.h"

#include <array>

#include "gi/pixel_rays.h"
#include "shaders/denoiser/denoiser_io.h"

namespace ag::gi {
namespace {

constexpr std::string_view kLight = "denoiser.light";
constexpr uint32_t kMostRounds = 5;
constexpr uint32_t kFramesOfChange = 8;  // after the light's last change in which histories may be cut short

// Names are literals, because the graph keeps views of them.
constexpr std::array<std::string_view, kMostRounds> kRoundNames = {
    "denoiser.filter0", "denoiser.filter1", "denoiser.filter2", "denoiser.filter3", "denoiser.filter4"};
constexpr std::array<std::string_view, kMostRounds> kLineNames = {
    "denoiser.lines0", "denoiser.lines1", "denoiser.lines2", "denoiser.lines3", "denoiser.lines4"};

struct Images {
    HistoryImage light;    // rgb: mean; a: frames it stands for
    HistoryImage surface;  // xyz: normal; w: m along the axis, 0: sky
    HistoryImage tiles;    // noise, change, lasting difference of 8 x 8 pixels
    BufferHandle cameras;
};

struct FilterRound {
    ImageHandle from, to;
    glm::ivec2 stride;
};

void addFilter(GraphScope scope, std::string_view name, const Images& images, const FilterRound& round,
               uint32_t seed, const DenoiserSettings& s) {
    const auto& [from, to, stride] = round;
    scope.compute(name, "denoiser/filter.comp")
        .sample("light", from)
        .sample("surface", images.surface.current)
        .sample("tiles", images.tiles.current, Sampler::kLinearClamp)
        .read("cameras", images.cameras)
        .write("result", to)
        .constant("kSquare", !s.separable)
        .push(io::FilterPush{stride.x, stride.y, s.lightTolerance, seed})
        .dispatchThreads(scope.info(to).size.x, scope.info(to).size.y);
}

}  // namespace

Irradiance addDenoiser(GraphScope scope, const Surfaces& gbuffer, uint64_t originVersion,
                       const NoisyLight& noisy, const DenoiserSettings& s, DenoiserHistory& history) {
    if (!s.enabled || !noisy.irradiance.image) return noisy.irradiance;
    const glm::uvec2 size = gbuffer.size, tileCount = (size + io::kDenoiserTile - 1u) / io::kDenoiserTile;
    const ImageInfo info{.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = size};
    const ImageInfo tileInfo{.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = tileCount};
    const RenderCamera& camera = gbuffer.view;
    const bool known = history.originVersion == originVersion;
    const RenderCamera before = known ? history.camera : camera;
    history = {camera, originVersion, noisy.lightVersion,
               history.lightVersion == noisy.lightVersion ? history.sinceLightChange + 1 : 0};
    const bool changing = s.adaptive && history.sinceLightChange < kFramesOfChange;

    Images images{.light = scope.historyImage(kLight, info),
                  .surface = scope.historyImage("denoiser.surface", info),
                  .tiles = scope.historyImage("denoiser.tiles", tileInfo)};
    images.cameras = addReprojectionCameras(scope, "denoiser.cameras", camera, before, size);
    const ImageHandle reprojected = scope.image("denoiser.reprojected", info);
    scope.compute("denoiser.reproject", "denoiser/reproject.comp")
        .sample("normalMap", gbuffer.normal)
        .sample("depthMap", gbuffer.depth)
        .samplePrevious("previousLight", images.light, Sampler::kNearestClamp)
        .samplePrevious("previousSurface", images.surface, Sampler::kNearestClamp)
        .read("cameras", images.cameras)
        .write("surface", images.surface.current)
        .write("history", reprojected)
        .sample("motionMap", gbuffer.motion ? gbuffer.motion : gbuffer.normal)
        .constant("kMotion", bool(gbuffer.motion))
        .push(io::ReprojectPush{camera.near, known && images.light.valid, noisy.step})
        .dispatchThreads(size.x, size.y);
    const ImageHandle excess = scope.image("denoiser.excess", tileInfo);
    scope.compute("denoiser.measure_tiles", "denoiser/measure_tiles.comp")
        .sample("samples", noisy.irradiance.image)
        .sample("history", reprojected)
        .samplePrevious("previousTiles", images.tiles, Sampler::kNearestClamp)
        .write("tiles", images.tiles.current)
        .write("excess", excess)
        .push(uint32_t(known && images.tiles.valid))
        .dispatchGroups(tileCount.x * tileCount.y);
    const uint32_t rounds = std::min(s.rounds, kMostRounds);
    const bool recurrent = s.recurrent && rounds > 0;
    const ImageHandle mean = recurrent ? scope.image("denoiser.mean", info) : images.light.current;
    scope.compute("denoiser.accumulate", "denoiser/accumulate.comp")
        .sample("samples", noisy.irradiance.image)
        .sample("history", reprojected)
        .sample("tiles", images.tiles.current, Sampler::kLinearClamp)
        .sample("excess", excess)
        .write("light", mean)
        .push(io::AccumulatePush{s.leastShare, float(s.mostLength), s.adaptive, changing, noisy.step})
        .dispatchThreads(size.x, size.y);

    // Two images take turns; lines go through a third.
    const std::array<ImageHandle, 2> turns = {scope.image("denoiser.even", info),
                                              scope.image("denoiser.odd", info)};
    const ImageHandle lines = scope.image("denoiser.lines", info);
    ImageHandle from = mean;
    for (uint32_t r = 0; r < rounds; ++r) {
        const ImageHandle to = r == 0 && recurrent ? images.light.current : turns[r % 2];
        const int stride = 1 << r;
        if (s.separable) {
            addFilter(scope, kLineNames[r], images, {from, lines, {stride, 0}}, noisy.step, s);
            addFilter(scope, kRoundNames[r], images, {lines, to, {0, stride}}, noisy.step, s);
        } else {
            addFilter(scope, kRoundNames[r], images, {from, to, {stride, stride}}, noisy.step, s);
        }
        from = to;
    }
    return {from};
}

void forgetPixels(GraphScope scope) {
    scope.resetHistory(kLight);
}

}  // namespace ag::gi
