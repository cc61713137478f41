#include "gi/sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/core/hash.h"
#include "gi/blue_noise.h"
#include "gi/occluder_trees.h"
#include "gi/pixel_rays.h"
#include "gi/ray_filter.h"
#include "gi/upsampling.h"
#include "shaders/bvh/bvh_io.h"
#include "shaders/ray_filter/ray_filter_io.h"

namespace ag::gi {
namespace {

constexpr VkFormat kFloat4 = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kTexelAngle = 4 * kPi / float(io::kSkySide * io::kSkySide);  // sr
constexpr float kEvenly = 0.05f;                                             // of the draws within a cell
// Of what blocks learned, from frame to frame; and while all stands.
constexpr float kKept = 0.9f, kKeptAtRest = 0.995f;
constexpr uint32_t kFramesOfChange = 48;  // means are kept short so long
constexpr float kMostPointRays = 65536;
constexpr uint32_t kMostRounds = 4;
constexpr float kOfNeighbours = 8;  // rays that their light counts for where a pixel's turn begins
// Names are literals, because the graph keeps views of them.
constexpr std::array<std::string_view, kMostRounds> kFilterNames = {"sky.filter0", "sky.filter1",
                                                                    "sky.filter2", "sky.filter3"};
constexpr std::array<std::string_view, kMostRounds> kGlossFilterNames = {
    "sky.gloss_filter0", "sky.gloss_filter1", "sky.gloss_filter2", "sky.gloss_filter3"};
// Of irradiance, and of what specular lobes reflect.
struct MeanNames {
    std::string_view pass, mean, square, surface, rest, cameras, even, odd;
    const std::array<std::string_view, kMostRounds>& filters;
};
constexpr MeanNames kIrradianceMeans = {"sky.accumulate", "sky.mean", "sky.square", "sky.surface", "sky.rest",
                                        "sky.cameras",    "sky.even", "sky.odd",    kFilterNames};
constexpr MeanNames kGlossMeans = {"sky.accumulate_gloss", "sky.gloss_mean", "sky.gloss_square",
                                   "sky.gloss_surface",    "sky.gloss_rest", "sky.gloss_cameras",
                                   "sky.gloss_even",       "sky.gloss_odd",  kGlossFilterNames};
constexpr DownsamplingNames kSkyDownsampling = {"sky.downsample_depth", "sky.downsample_normal",
                                                "sky.downsample_camera", "sky.downsample_motion"};
constexpr UpsamplingNames kSkyUpsampling = {
    "sky.upsample",
    "sky.upsample_far",
    "sky.irradiance",
    {"sky.lacking", "sky.none_lacking", "sky.lacking_groups", "sky.no_lacking_groups"},
    {"sky.alone", "sky.none_alone", "sky.alone_groups", "sky.no_alone_groups"},
    "",
    "sky.place"};
constexpr UpsamplingNames kGlossUpsampling = {
    "sky.upsample_gloss",
    "sky.upsample_gloss_far",
    "sky.gloss",
    {"sky.gloss_lacking", "sky.none_gloss_lacking", "sky.gloss_lacking_groups",
     "sky.no_gloss_lacking_groups"},
    {"sky.gloss_alone", "sky.none_gloss_alone", "sky.gloss_alone_groups", "sky.no_gloss_alone_groups"},
    "",
    "sky.place_gloss"};
constexpr float kWalkingLength = 8;  // frames that reflections stand for while the camera moves

float mean(glm::vec3 v) {
    return (v.x + v.y + v.z) / 3;
}

uint32_t texelOf(glm::vec3 d) {
    const float turn = std::atan2(d.z, d.x) / (2 * kPi) + 0.5f, down = 0.5f - 0.5f * d.y;
    const glm::uvec2 at =
        glm::min(glm::uvec2(glm::clamp(glm::vec2(turn, down), 0.0f, 1.0f) * float(io::kSkySide)),
                 glm::uvec2(io::kSkySide - 1));
    const glm::uvec2 cell = at / io::kSkyCell, in = at % io::kSkyCell;
    return (cell.y * (io::kSkySide / io::kSkyCell) + cell.x) * io::kSkyCellTexels + in.y * io::kSkyCell +
           in.x;
}

struct Sent {
    ImageHandle irradiance, gloss;
};

Sent addRays(GraphScope scope, const Surfaces& gbuffer, const SkyInputs& in, uint32_t step, float keep) {
    const glm::uvec2 along = (gbuffer.size + io::kSkyBlock - 1u) / io::kSkyBlock;
    const uint32_t blocks = along.x * along.y;
    const uint64_t entries = uint64_t(blocks) * io::kSkyCells;
    const HistoryBuffer seen = scope.historyBuffer("sky.seen", {.sizeBytes = entries * sizeof(glm::vec2)});
    const BufferHandle upTo = scope.buffer("sky.up_to", {.sizeBytes = entries * sizeof(float)});
    scope.compute("sky.choose", "sky/choose.comp")
        .sample("normalMap", gbuffer.normal)
        .sample("depthMap", gbuffer.depth)
        .read("cells", in.sky.cells)
        .readPrevious("seen", seen)
        .readWrite("upTo", upTo)
        .push(io::SkyChoosePush{seen.valid})
        .step(step)
        .dispatchGroups(blocks);
    Sent sent{.irradiance = scope.image("sky.sent", {.format = kFloat4, .size = gbuffer.size}), .gloss = {}};
    if (gbuffer.reflectance)
        sent.gloss = scope.image("sky.sent_gloss", {.format = kFloat4, .size = gbuffer.size});
    const BufferHandle noise = addBlueNoise(scope);
    PassBuilder cast = scope.compute("sky.cast", "sky/cast.comp");
    cast.sample("normalMap", gbuffer.normal)
        .sample("depthMap", gbuffer.depth)
        .read("camera", gbuffer.camera)
        .read("skyTexels", in.sky.texels)
        .read("upTo", upTo)
        .readPrevious("before", seen)
        .write("seen", seen.current)
        .write("sent", sent.irradiance)
        .write("shone", sent.gloss ? sent.gloss : sent.irradiance)
        .sample("reflectanceMap", sent.gloss ? gbuffer.reflectance : gbuffer.normal)
        .constant("kGlossy", bool(sent.gloss))
        .read("noise", noise)
        .push(io::SkyCastPush{.step = step,
                              .shift = blueNoiseShift(step),
                              .offset = io::kBvhOffset * in.occluders.extent,
                              .reach = kRayReaches * in.occluders.extent,
                              .known = seen.valid,
                              .keep = keep})
        .step(step)
        .dispatchGroups(blocks);
    readTrees(cast, in.occluders.trees);
    return sent;
}

struct Followed {  // from the frame before
    RenderCamera camera;
    bool known;
};

// Averaged over frames and filtered over the screen.
ImageHandle addMeans(GraphScope scope, const Surfaces& gbuffer, ImageHandle sent, const Followed& before,
                     io::SkyMeanPush push, uint32_t step, const SkySettings& s, const MeanNames& names) {
    const ImageInfo info{.format = kFloat4, .size = gbuffer.size};
    const HistoryImage mean = scope.historyImage(names.mean, info),
                       square = scope.historyImage(names.square,
                                                   {.format = VK_FORMAT_R32_SFLOAT, .size = gbuffer.size}),
                       surface = scope.historyImage(
                           names.surface, {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = gbuffer.size});
    const ImageHandle rest = scope.image(names.rest, info);
    const BufferHandle cameras =
        addReprojectionCameras(scope, names.cameras, gbuffer.view, before.camera, gbuffer.size);
    push.near = gbuffer.view.near;
    push.valid = before.known && mean.valid;
    scope.compute(names.pass, "sky/accumulate.comp")
        .sample("normalMap", gbuffer.normal)
        .sample("depthMap", gbuffer.depth)
        .sample("sent", sent)
        .samplePrevious("previousMean", mean, Sampler::kNearestClamp)
        .samplePrevious("previousSquare", square, Sampler::kNearestClamp)
        .samplePrevious("previousSurface", surface, Sampler::kNearestClamp)
        .read("cameras", cameras)
        .write("meanOf", mean.current)
        .write("squareOf", square.current)
        .write("surface", surface.current)
        .write("rest", rest)
        .sample("motionMap", gbuffer.motion ? gbuffer.motion : gbuffer.normal)
        .constant("kMotion", bool(gbuffer.motion))
        .push(push)
        .step(step)
        .dispatchThreads(gbuffer.size.x, gbuffer.size.y);
    const std::array<ImageHandle, 2> turns = {scope.image(names.even, info), scope.image(names.odd, info)};
    ImageHandle from = rest;
    const uint32_t rounds = std::min(s.rounds, kMostRounds);
    for (uint32_t round = 0; round < rounds; ++round) {
        scope.compute(names.filters[round], "ray_filter/filter.comp")
            .sample("rest", from)
            .sample("surface", surface.current)
            .read("cameras", cameras)
            .write("result", turns[round % 2])
            .constant("kDeviation", round + 1 == rounds)
            .push(io::RayFilterPush{int(1u << round), s.tolerance})
            .dispatchThreads(gbuffer.size.x, gbuffer.size.y);
        from = turns[round % 2];
    }
    return from;
}

// Where the camera was; and notes how long ago what is seen of the sky may have changed.
Followed followFrames(const Surfaces& gbuffer, const SkyInputs& in, SkyHistory& history) {
    const bool known = history.originVersion == in.versions.origin;
    const Followed before{known ? history.camera : gbuffer.view, known};
    history.camera = gbuffer.view;
    history.originVersion = in.versions.origin;
    const uint64_t light = combineHash(in.sky.version, in.versions.instances);
    history.sinceChange = history.lightVersion == light ? history.sinceChange + 1 : 0;
    history.lightVersion = light;
    history.sinceStep = history.cameraVersion == in.versions.camera ? history.sinceStep + 1 : 0;
    history.cameraVersion = in.versions.camera;
    return before;
}

uint32_t turnsOf(uint32_t spacing, const SkySettings& s) {
    return s.allPixels ? spacing * spacing : 1;
}

// Whose turn it is of a square's pixels.
struct Turn {
    uint32_t number = 0;
    bool begins = false;  // and others came before
};

Turn turnOf(uint32_t turns, const SkySettings& s, uint32_t sinceChange) {
    const uint32_t number = std::min(sinceChange / s.settleFrames, turns - 1);
    return {number, number > 0 && sinceChange == number * s.settleFrames};
}

ImageHandle toPixels(GraphScope scope, const Surfaces& all, const Surfaces& gathered, ImageHandle light,
                     const Turn& turn, const SkySettings& s, const UpsamplingNames& names,
                     const JoinNames& join) {
    if (turn.number == 0 || !hasAllPixels(scope, names))
        return addUpsampling(scope, all, gathered, Irradiance{light}, names).image;
    const ImageHandle placed = addPlacing(scope, all, gathered, Irradiance{light}, names).image;
    return s.rounds > 0 ? addJoinedTurns(scope, all, placed, s.tolerance, join) : placed;
}

}  // namespace

SkyTable makeSkyTable(FunctionRef<void(AddRadiance)> add) {
    constexpr uint32_t kTexels = io::kSkySide * io::kSkySide;
    std::vector<glm::dvec4> sums(kTexels, glm::dvec4(0));
    add([&](glm::vec3 direction, glm::vec3 radiance, float solidAngle) {
        sums[texelOf(direction)] += glm::dvec4(glm::dvec3(radiance), 1) * double(solidAngle);
    });
    SkyTable table;
    table.texels.resize(kTexels);
    float total = 0;
    for (uint32_t cell = 0; cell < io::kSkyCells; ++cell) {
        io::SkyTexel* const texels = &table.texels[size_t(cell) * io::kSkyCellTexels];
        float power = 0, upTo = 0;
        for (uint32_t t = 0; t < io::kSkyCellTexels; ++t) {
            const glm::dvec4& sum = sums[size_t(cell) * io::kSkyCellTexels + t];
            // Energy is kept exactly: what was given over the texel's own angle.
            texels[t].radiance = glm::vec3(glm::dvec3(sum)) / kTexelAngle;
            power += mean(texels[t].radiance) * kTexelAngle;
        }
        for (uint32_t t = 0; t < io::kSkyCellTexels; ++t) {
            const float share = power > 0 ? mean(texels[t].radiance) * kTexelAngle / power : 0;
            upTo +=
                power > 0 ? kEvenly / io::kSkyCellTexels + (1 - kEvenly) * share : 1.0f / io::kSkyCellTexels;
            texels[t].upTo = upTo;
        }
        texels[io::kSkyCellTexels - 1].upTo = 1;
        table.cells.push_back(power);
        table.upTo.push_back(total += power);
    }
    return table;
}

SkyLight addSkyLight(GraphScope scope, const Surfaces& surfaces, uint32_t spacing, const SkyInputs& in,
                     const SkySettings& s, SkyHistory& history) {
    if (!s.enabled || !in.sky || !in.occluders.trees.moverNodes) return {};
    const uint64_t seen = combineHash(in.sky.version, combineHash(in.versions.camera, in.versions.instances));
    const uint32_t turns = turnsOf(spacing, s);
    const uint32_t step = history.settling.advance(seen, turns * s.settleFrames);
    const Turn turn = turnOf(turns, s, history.settling.sinceChange);
    const Downsampling at = Downsampling::ofTurn(spacing, turn.number);
    Surfaces gbuffer = addDownsampled(scope, surfaces, at, kSkyDownsampling);
    gbuffer.reflectance = {};
    if (s.glossy && surfaces.reflectance)
        gbuffer.reflectance =
            spacing == 1 ? surfaces.reflectance
                         : addDownsampledImage(scope, "sky.downsample_reflectance", surfaces.reflectance, at);
    const Followed before = followFrames(gbuffer, in, history);
    const bool moving = history.sinceChange < kFramesOfChange, walking = history.sinceStep == 0;
    const Sent sent = addRays(scope, gbuffer, in, step, moving || walking ? kKept : kKeptAtRest);
    io::SkyMeanPush push{.mostLength = float(moving ? s.movingLength : s.mostLength), .moving = moving};
    if (turn.begins) push.mostLength = kOfNeighbours;
    const ImageHandle mean =
        addMeans(scope, gbuffer, sent.irradiance, before, push, step, s, kIrradianceMeans);
    SkyLight light{
        toPixels(scope, surfaces, gbuffer, mean, turn, s, kSkyUpsampling, {"sky.join", "sky.joined"}), {}};
    if (!sent.gloss) return light;
    if (walking) push.mostLength = std::min(push.mostLength, kWalkingLength);
    const ImageHandle gloss = addMeans(scope, gbuffer, sent.gloss, before, push, step, s, kGlossMeans);
    light.gloss = toPixels(scope, surfaces, gbuffer, gloss, turn, s, kGlossUpsampling,
                           {"sky.join_gloss", "sky.gloss_joined"});
    return light;
}

BufferHandle addSkyOnPoints(GraphScope scope, const SurfaceEmitters& emitters, const SkyInputs& in,
                            const SkySettings& s, Settling& settling) {
    const uint32_t count = emitters.reflecting.count();
    if (!s.enabled || !in.sky || count == 0 || !in.occluders.trees.moverNodes) return {};
    const uint64_t seen = combineHash(in.sky.version, in.versions.instances);
    const uint32_t step = settling.advance(seen, s.settleFrames);
    const bool moving = settling.sinceChange < kFramesOfChange;
    const HistoryBuffer irradiance = scope.historyBuffer(
        "sky.on_points", {.sizeBytes = count * sizeof(glm::vec4), .texelFormat = kFloat4});
    PassBuilder pass = scope.compute("sky.points", "sky/points.comp");
    pass.read("texels", emitters.texels)
        .read("skyTexels", in.sky.texels)
        .read("upTo", in.sky.upTo)
        .readPrevious("before", irradiance)
        .write("irradiance", irradiance.current)
        .push(io::SkyPointsPush{.count = count,
                                .rays = s.pointRays,
                                .step = step,
                                .offset = io::kBvhOffset * in.occluders.extent,
                                .reach = kRayReaches * in.occluders.extent,
                                .valid = irradiance.valid,
                                .mostLength = moving ? float(s.movingLength * s.pointRays) : kMostPointRays})
        .step(step)
        .dispatchThreads(count);
    readTrees(pass, in.occluders.trees);
    return irradiance.current;
}

}  // namespace ag::gi
