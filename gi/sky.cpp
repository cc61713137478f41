#include "gi/sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/equirectangular.h"
#include "engine/core/hash.h"
#include "gi/blue_noise.h"
#include "gi/occluder_trees.h"
#include "gi/ray_filter.h"
#include "gi/upsampling.h"
#include "shaders/bvh/bvh_io.h"

namespace ag::gi {
namespace {

constexpr VkFormat kSkyFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kTexelAngle = 4 * kPi / float(io::kSkySide * io::kSkySide);  // sr
constexpr float kEvenly = 0.05f;                                             // of the draws within a cell
// Of what blocks learned, from frame to frame; and while all stands.
constexpr float kKept = 0.9f, kKeptAtRest = 0.995f;
constexpr uint32_t kFramesOfChange = 48;  // means are kept short so long
constexpr float kMostPointRays = 65536;
constexpr RayMeanNames kIrradianceMeans = {
    "sky.accumulate",
    "sky.mean",
    "sky.square",
    "sky.surface",
    "sky.rest",
    "sky.cameras",
    {"sky.even", "sky.odd", {"sky.filter0", "sky.filter1", "sky.filter2", "sky.filter3"}}};
constexpr RayMeanNames kGlossMeans = {
    "sky.accumulate_gloss",
    "sky.gloss_mean",
    "sky.gloss_square",
    "sky.gloss_surface",
    "sky.gloss_rest",
    "sky.gloss_cameras",
    {"sky.gloss_even",
     "sky.gloss_odd",
     {"sky.gloss_filter0", "sky.gloss_filter1", "sky.gloss_filter2", "sky.gloss_filter3"}}};
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

// Of each texel of the table: radiance times solid angle, and solid angle. The picture's texels one by one
// where they are finer than the table's, else places between them.
std::vector<glm::dvec4> radianceOfTexels(const SkyPicture& picture, float lightUnit) {
    constexpr glm::ivec2 kLeast{512, 256};
    const bool fine = picture.size.x >= kLeast.x && picture.size.y >= kLeast.y;
    const glm::ivec2 size = fine ? picture.size : kLeast;
    std::vector<glm::dvec4> sums(io::kSkySide * io::kSkySide, glm::dvec4(0));
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const glm::vec3 direction = skyDirection((glm::vec2(x, y) + 0.5f) / glm::vec2(size));
            const glm::vec3 radiance = fine ? picture.radiance[size_t(y) * size_t(size.x) + size_t(x)]
                                            : lookUpDirection(picture.size, picture.radiance, direction);
            sums[texelOf(picture.worldFromPicture * direction)] +=
                glm::dvec4(glm::dvec3(radiance / lightUnit), 1) * double(skyTexelAngle(size, y));
        }
    return sums;
}

struct SkySent {
    ImageHandle irradiance, gloss;
};

SkySent addRays(GraphScope scope, const Surfaces& gbuffer, const SkyInputs& in, uint32_t step, float keep) {
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
    SkySent sent{.irradiance = scope.image("sky.sent", {.format = kSkyFormat, .size = gbuffer.size}),
                 .gloss = {}};
    if (gbuffer.reflectance)
        sent.gloss = scope.image("sky.sent_gloss", {.format = kSkyFormat, .size = gbuffer.size});
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
                              .offset = in.occluders.rayOffset,
                              .pixelOffset = in.occluders.trees.snapping / float(gbuffer.spacing),
                              .reach = kRayReaches * in.occluders.extent,
                              .known = seen.valid,
                              .keep = keep})
        .step(step)
        .dispatchGroups(blocks);
    readTrees(cast, in.occluders.trees);
    return sent;
}

// Where the camera was; and notes how long ago what is seen of the sky may have changed.
FollowedCamera followFrames(const Surfaces& gbuffer, const SkyInputs& in, SkyHistory& history) {
    const bool known = history.originVersion == in.versions.origin;
    const FollowedCamera before = followCamera(gbuffer.view, history.camera, known);
    history.originVersion = in.versions.origin;
    const uint64_t light = combineHash(in.sky.version, in.versions.instances);
    history.sinceChange = history.lightVersion == light ? history.sinceChange + 1 : 0;
    history.lightVersion = light;
    history.sinceStep = history.viewVersion == in.versions.view ? history.sinceStep + 1 : 0;
    history.viewVersion = in.versions.view;
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

}  // namespace

SkyTable makeSkyTable(const SkyPicture& picture, float lightUnit) {
    constexpr uint32_t kTexels = io::kSkySide * io::kSkySide;
    const std::vector<glm::dvec4> sums = radianceOfTexels(picture, lightUnit);
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

uint32_t framesToRest(const SkySettings& s, uint32_t spacing) {
    return turnsOf(spacing, s) * s.settleFrames;
}

SkyLight addSkyLight(GraphScope scope, const Surfaces& surfaces, uint32_t spacing, const SkyInputs& in,
                     const SkySettings& s, SkyHistory& history) {
    if (!s.enabled || !in.sky || !in.occluders.trees.moverNodes) return {};
    const uint64_t seen = combineHash(in.sky.version, combineHash(in.versions.camera, in.versions.instances));
    const uint32_t turns = turnsOf(spacing, s);
    const uint32_t step = history.settling.advance(seen, framesToRest(s, spacing));
    const Turn turn = turnOf(turns, s, history.settling.sinceChange);
    const Downsampling at = Downsampling::ofTurn(spacing, turn.number);
    Surfaces gbuffer = addDownsampled(scope, surfaces, at, kSkyDownsampling);
    gbuffer.reflectance = {};
    if (s.glossy && surfaces.reflectance)
        gbuffer.reflectance =
            spacing == 1 ? surfaces.reflectance
                         : addDownsampledImage(scope, "sky.downsample_reflectance", surfaces.reflectance, at);
    const FollowedCamera before = followFrames(gbuffer, in, history);
    const bool moving = history.sinceChange < kFramesOfChange, walking = history.sinceStep == 0;
    const SkySent sent = addRays(scope, gbuffer, in, step, moving || walking ? kKept : kKeptAtRest);
    RayMeans means{.sent = sent.irradiance,
                   .before = before,
                   .mostLength = float(moving ? s.movingLength : s.mostLength),
                   .moving = moving,
                   .step = step,
                   .filter = {s.rounds, s.tolerance}};
    if (turn.begins) means.mostLength = kOfNeighbours;
    const auto lightOf = [&](const RayMeanNames& names, const TurnNames& toPixels) {
        const ImageHandle mean = addRayMeans(scope, gbuffer, means, names);
        return addTurn(scope, surfaces, gbuffer, mean, turn.number, means.filter, toPixels);
    };
    SkyLight light{lightOf(kIrradianceMeans, {kSkyUpsampling, {"sky.join", "sky.joined"}}), {}};
    if (!sent.gloss) return light;
    means.sent = sent.gloss;
    if (walking) means.mostLength = std::min(means.mostLength, kWalkingLength);
    light.gloss = lightOf(kGlossMeans, {kGlossUpsampling, {"sky.join_gloss", "sky.gloss_joined"}});
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
        "sky.on_points", {.sizeBytes = count * sizeof(glm::vec4), .texelFormat = kSkyFormat});
    PassBuilder pass = scope.compute("sky.points", "sky/points.comp");
    pass.read("texels", emitters.texels)
        .read("skyTexels", in.sky.texels)
        .read("upTo", in.sky.upTo)
        .readPrevious("before", irradiance)
        .write("irradiance", irradiance.current)
        .push(io::SkyPointsPush{.count = count,
                                .rays = s.pointRays,
                                .step = step,
                                .offset = in.occluders.rayOffset,
                                .reach = kRayReaches * in.occluders.extent,
                                .valid = irradiance.valid,
                                .mostLength = moving ? float(s.movingLength * s.pointRays) : kMostPointRays})
        .step(step)
        .dispatchThreads(count);
    readTrees(pass, in.occluders.trees);
    return irradiance.current;
}

}  // namespace ag::gi
