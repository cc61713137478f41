#include "gi/texel_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "engine/core/hash.h"
#include "gi/blue_noise.h"
#include "gi/gather_grid.h"
#include "gi/occluder_trees.h"
#include "gi/pixel_rays.h"
#include "gi/ray_filter.h"
#include "shaders/bvh/bvh_io.h"
#include "shaders/texel_rays/texel_rays_io.h"

namespace ag::gi {
namespace {

constexpr VkFormat kFloat4 = VK_FORMAT_R32G32B32A32_SFLOAT, kHalf4 = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr RayFilterNames kFilter = {
    "texel_rays.even",
    "texel_rays.odd",
    {"texel_rays.filter0", "texel_rays.filter1", "texel_rays.filter2", "texel_rays.filter3"}};

constexpr uint32_t kFirstMovingRay = 1u << 28;  // unlike those of a still picture
// Rays that a block remembers of a light. At most so many, because clusters settle; fewer in motion, when the
// block soon shows other surfaces.
constexpr float kRaysKnown = 4096, kRaysKnownMoving = 256;
// Frames whose variance is not to be believed. A still picture can wait for more, and draws that have not
// learned yet need more.
constexpr float kFew = 14, kFewMoving = 7;

// How likely pixels of a block are to draw each light.
struct Choice {
    BufferHandle upTo, likely, found;
    uint32_t blocks;
};

// `ray`: number of the frame's rays; `known`: rays of the frame before tell of what these will find.
Choice addChoice(const ValTiles& t, uint32_t ray, bool known, float mostKnown) {
    const glm::uvec2 along = (t.gbuffer.size + io::kDrawBlock - 1u) / io::kDrawBlock;
    const uint32_t blocks = along.x * along.y;
    const BufferInfo info{.sizeBytes = uint64_t(blocks) * t.push.valCount * 4,
                          .texelFormat = VK_FORMAT_R32_SFLOAT};
    const HistoryBuffer found = t.scope.historyBuffer(
        "texel_rays.found", {.sizeBytes = uint64_t(blocks) * t.push.valCount * sizeof(io::RaysFound)});
    const Choice choice{t.scope.buffer("texel_rays.up_to", info), t.scope.buffer("texel_rays.likely", info),
                        found.current, blocks};
    t.scope.fill("texel_rays.none_likely", choice.likely, 0);
    gatherPass(t, "texel_rays.choose", "texel_rays/choose_lights.comp", ValShape::kVectorDisk, 1)
        .readWrite("likely", choice.likely)
        .readWrite("upTo", choice.upTo)
        .readPrevious("foundBefore", found)
        .write("found", found.current)
        .push(io::ChoosePush{t.push, ray, found.valid && known, mostKnown})
        .dispatchGroups(choice.blocks);
    return choice;
}

// What was sent by the texel drawn, and by what the hemisphere's ray met.
struct Sent {
    ImageHandle drawn, near;
};

// Those that hemisphere's rays may find texels of.
uint32_t mapsOf(const Vals& vals, const RsmSet& rsm) {
    return vals.first < rsm.firstLater && vals.count > rsm.emissiveCount ? rsm.lightRsmCount : 0;
}

uint32_t emissiveMapOf(const Vals& vals, const RsmSet& rsm) {
    return vals.first < rsm.emissiveCount ? rsm.lightRsmCount : ~0u;
}

uint32_t laterMapOf(const Vals& vals, const TexelRaysInputs& in) {
    return vals.count > in.rsm.firstLater && in.endless ? in.rsm.atlas.mapCount - 1 : ~0u;
}

// `reach`: in the scene's extent.
Sent addRays(const ValTiles& t, const Choice& choice, const TexelRaysInputs& in, float reach, uint32_t ray) {
    const ImageInfo info{.format = kFloat4, .size = t.gbuffer.size};
    const Sent sent{t.scope.image("texel_rays.sent", info), t.scope.image("texel_rays.sent_near", info)};
    const BufferHandle noise = addBlueNoise(t.scope);
    const float snapping = in.occluders.trees.snapping, most = reach * in.occluders.extent;
    PassBuilder cast = t.scope.compute("texel_rays.cast", "texel_rays/cast_rays.comp");
    cast.sample("normalMap", t.gbuffer.normal)
        .sample("depthMap", t.gbuffer.depth)
        .read("camera", t.gbuffer.camera)
        .read("faces", in.rsm.faces)
        .read("lists", t.lists)
        .read("counts", t.counts)
        .read("upTo", choice.upTo)
        .read("likely", choice.likely)
        .read("slotOfTexel", in.clusters.slotOfTexel)
        .read("candidates", in.clusters.candidates)
        .read("noise", noise)
        .read("skyTexels", in.sky ? in.sky.texels : in.rsm.texels)  // compiled out without
        .read("skyUpTo", in.sky ? in.sky.upTo : noise)
        .constant("kSky", bool(in.sky))
        .write("sent", sent.drawn)
        .write("sentNear", sent.near)
        .readWrite("found", choice.found)
        .push(io::CastPush{.tiles = t.push,
                           .atlasWidth = in.rsm.atlas.size.x,
                           .mapCount = mapsOf(t.lights.vals, in.rsm),
                           .emissiveMap = emissiveMapOf(t.lights.vals, in.rsm),
                           .laterMap = laterMapOf(t.lights.vals, in),
                           .ray = ray,
                           .shift = blueNoiseShift(ray),
                           .offset = in.occluders.rayOffset,
                           .pixelOffset = snapping / float(t.gbuffer.spacing),
                           .texelOffset = snapping,
                           .reach = most,
                           .emissiveReach = reachOfPoints(in.occluders.emissivePointArea, most),
                           .laterReach = reachOfPoints(in.occluders.bouncePointArea, most)})
        .dispatchGroups(choice.blocks);
    readRsmTexels(cast, in.rsm);
    readMembers(cast, in.members);
    readTrees(cast, in.occluders.trees);
    return sent;
}

ImageHandle addControl(const ValTiles& t, const Choice& choice, ImageHandle sent,
                       const ValShadingSettings& s) {
    const ImageHandle control =
        t.scope.image("texel_rays.control", {.format = kFloat4, .size = t.gbuffer.size});
    const auto measure = [&](std::string_view name, uint32_t list, ValShape shape, uint32_t taps) {
        gatherPass(t, name, "texel_rays/measure_control.comp", shape, taps)
            .sample("sent", sent)
            .read("likely", choice.likely)
            .readWrite("control", control)
            .constant("kList", list)
            .dispatchThreads(t.gbuffer.size.x * t.gbuffer.size.y);
    };
    measure("texel_rays.control_far", io::kFarList, s.farShape, s.farTaps);
    measure("texel_rays.control_near", io::kNearList, s.shape, s.taps);
    return control;
}

// Of the surfaces that pixels see, now and in the frame before.
struct Seen {
    HistoryImage surface;
    BufferHandle cameras;
    bool known;  // there is a frame before
};

Seen addSeen(const ValTiles& t, uint64_t originVersion, TexelRaysHistory& history) {
    const bool known = history.originVersion == originVersion;
    const FollowedCamera before = followCamera(t.gbuffer.view, history.camera, known);
    history.originVersion = originVersion;
    const ImageInfo info{.format = kHalf4, .size = t.gbuffer.size};
    return {
        t.scope.historyImage("texel_rays.surface", info),
        addReprojectionCameras(t.scope, "texel_rays.cameras", t.gbuffer.view, before.camera, t.gbuffer.size),
        known};
}

struct Means {
    HistoryImage sent, control, moments;
};

struct Measured {
    ImageHandle areaLights;
    Sent sent;
    ImageHandle control;
    float mostLength;  // frames that means stand for
    bool follows;      // on rays of the frame before
    bool worldMoves;   // what rays find may have changed
    uint32_t step;
};

Means addMeans(const ValTiles& t, const Measured& of, const Seen& seen) {
    const ImageInfo info{.format = kFloat4, .size = t.gbuffer.size};
    const Means m{.sent = t.scope.historyImage("texel_rays.sent_mean", info),
                  .control = t.scope.historyImage("texel_rays.control_mean", info),
                  .moments = t.scope.historyImage("texel_rays.moments", info)};
    t.scope.compute("texel_rays.accumulate", "texel_rays/accumulate.comp")
        .sample("normalMap", t.gbuffer.normal)
        .sample("depthMap", t.gbuffer.depth)
        .sample("areaLights", of.areaLights)
        .sample("sent", of.sent.drawn)
        .sample("sentNear", of.sent.near)
        .sample("control", of.control)
        .samplePrevious("previousSent", m.sent, Sampler::kNearestClamp)
        .samplePrevious("previousControl", m.control, Sampler::kNearestClamp)
        .samplePrevious("previousMoments", m.moments, Sampler::kNearestClamp)
        .samplePrevious("previousSurface", seen.surface, Sampler::kNearestClamp)
        .read("cameras", seen.cameras)
        .write("sentMean", m.sent.current)
        .write("controlMean", m.control.current)
        .write("moments", m.moments.current)
        .write("surface", seen.surface.current)
        .sample("motionMap", t.gbuffer.motion ? t.gbuffer.motion : t.gbuffer.normal)
        .constant("kMotion", bool(t.gbuffer.motion))
        .push(io::RayAccumulatePush{.near = t.gbuffer.view.near,
                                    .valid = of.follows && seen.known && m.sent.valid && seen.surface.valid,
                                    .mostLength = of.mostLength,
                                    .moving = of.worldMoves})
        .step(of.step)
        .dispatchThreads(t.gbuffer.size.x, t.gbuffer.size.y);
    return m;
}

// What was added to the area lights' light, for when no rays are cast.
struct Carried {
    HistoryImage correction, carried;
    ImageHandle irradiance;
};

Carried addCarried(const ValTiles& t, const Irradiance& areaLights) {
    const ImageInfo info{.format = kHalf4, .size = t.gbuffer.size};
    return {t.scope.historyImage("texel_rays.correction", info),
            t.scope.historyImage("texel_rays.carried", info),
            t.scope.image("texel_rays.irradiance", t.scope.info(areaLights.image))};
}

Irradiance carry(const ValTiles& t, const Irradiance& areaLights, const Seen& seen, float dimming,
                 uint32_t step) {
    const Carried c = addCarried(t, areaLights);
    t.scope.compute("texel_rays.carry", "texel_rays/carry.comp")
        .sample("normalMap", t.gbuffer.normal)
        .sample("depthMap", t.gbuffer.depth)
        .sample("areaLights", areaLights.image)
        .samplePrevious("previousCorrection", c.correction, Sampler::kNearestClamp)
        .samplePrevious("previousSurface", seen.surface, Sampler::kNearestClamp)
        .read("cameras", seen.cameras)
        .write("irradiance", c.irradiance)
        .write("correction", c.correction.current)
        .write("surface", seen.surface.current)
        .push(io::CarryPush{t.gbuffer.view.near, seen.known && c.correction.valid && seen.surface.valid,
                            dimming})
        .step(step)
        .dispatchThreads(t.gbuffer.size.x, t.gbuffer.size.y);
    return {c.irradiance, areaLights.toward};
}

// What was carried from before the last change, and how long it stays.
struct Keeping {
    bool fromCorrection;  // the frame before's
    bool moving;
    float few;  // frames: the variance of so few is not to be believed
    float share, dimming;
    uint32_t step;
};

Irradiance addCorrection(const ValTiles& t, const Irradiance& areaLights, const Means& m, const Seen& seen,
                         const TexelRaysSettings& s, const Keeping& keeping) {
    const glm::uvec2 size = t.gbuffer.size;
    const ImageInfo info{.format = kFloat4, .size = size};
    const ImageHandle rest = t.scope.image("texel_rays.rest", info);
    const ImageHandle share =
        t.scope.image("texel_rays.share", {.format = VK_FORMAT_R32_SFLOAT, .size = size});
    t.scope.compute("texel_rays.regress", "texel_rays/regress.comp")
        .sample("areaLights", areaLights.image)
        .sample("sentMean", m.sent.current)
        .sample("controlMean", m.control.current)
        .sample("moments", m.moments.current)
        .sample("surface", seen.surface.current)
        .read("cameras", seen.cameras)
        .write("rest", rest)
        .write("shareOf", share)
        .push(io::RegressPush{keeping.few})
        .dispatchThreads(size.x, size.y);
    const ImageHandle filtered = addRayFilter(t.scope, size, {rest, seen.surface.current, seen.cameras},
                                              {s.rounds, s.tolerance}, kFilter, FilterAlpha::kVariance);
    const Carried c = addCarried(t, areaLights);
    const HistoryImage& before = keeping.fromCorrection ? c.correction : c.carried;
    t.scope.compute("texel_rays.correct", "texel_rays/correct.comp")
        .sample("areaLights", areaLights.image)
        .sample("rest", filtered)
        .sample("shareOf", share)
        .samplePrevious("previousCarried", before, Sampler::kNearestClamp)
        .write("irradiance", c.irradiance)
        .write("correction", c.correction.current)
        .write("carried", c.carried.current)
        .sample("surface", seen.surface.current)
        .samplePrevious("previousSurface", seen.surface, Sampler::kNearestClamp)
        .read("cameras", seen.cameras)
        .sample("motionMap", t.gbuffer.motion ? t.gbuffer.motion : t.gbuffer.normal)
        .constant("kMotion", bool(t.gbuffer.motion))
        .push(io::CorrectPush{seen.known && before.valid && seen.surface.valid,
                              keeping.share * keeping.dimming, keeping.moving})
        .step(keeping.step)
        .dispatchThreads(size.x, size.y);
    return {c.irradiance, areaLights.toward};
}

// What surfaces keep can be no brighter, over what it was, than the light that dimmed least.
float dimmingOf(const RsmSet& rsm, TexelRaysHistory& history) {
    const std::span ids(history.lightIds.data(), history.lightCount);
    float most = rsm.emissiveCount == 0 ? 0 : 1;
    std::array<float, io::kMaxLightMaps> strengths{};
    for (uint32_t i = 0; i < rsm.lightRsmCount; ++i) {
        strengths[i] = io::luminance(rsm.mapInfo[i].intensity);
        const size_t before = size_t(std::ranges::find(ids, rsm.lightIds[i]) - ids.begin());
        const bool known = before < ids.size() && history.lightStrengths[before] > 0;
        most = std::max(most, known ? strengths[i] / history.lightStrengths[before] : 1);
    }
    history.lightCount = rsm.lightRsmCount;
    std::copy_n(rsm.lightIds.begin(), rsm.lightRsmCount, history.lightIds.begin());
    history.lightStrengths = strengths;
    return std::min(most, 1.0f);
}

}  // namespace

uint64_t versionOfLight(const Versions& v, const Occluders& occluders, const SkyOnDevice& sky) {
    uint64_t hash = sky ? sky.version : 0;
    for (const uint64_t part : {v.scene, v.instances, v.lights, v.origin, occluders.trees.staticVersion})
        hash = combineHash(hash, part);
    return hash;
}

float reachOfPoints(float area, float most) {
    constexpr float kNearPoints = 3;  // of their spacing
    return std::min(kNearPoints * std::sqrt(area), most);
}

bool castsTexelRays(const TexelRaysSettings& s, const Occluders& occluders) {
    return s.enabled && occluders.trees && occluders.trees.moverNodes;
}

Irradiance addTexelRays(const ValTiles& t, const Irradiance& areaLights, const TexelRaysInputs& in,
                        const ValShadingSettings& shading, const TexelRaysSettings& s,
                        TexelRaysHistory& history) {
    if (!areaLights.image || !castsTexelRays(s, in.occluders)) return areaLights;
    const uint32_t step = history.settling.advance(combineHash(in.grid.turn, in.grid.change), in.grid.frames);
    const Seen seen = addSeen(t, in.versions.origin, history);
    const float dimming = dimmingOf(in.rsm, history);
    const bool wasWhole = std::exchange(history.whole, in.whole);
    const uint64_t world = versionOfLight(in.versions, in.occluders, in.sky);
    const bool worldMoves = std::exchange(history.world, world) != world;
    const uint32_t still = history.settling.sinceChange;
    const bool moving = in.moving;
    if (still == 0 && !moving) {
        history.casts = 0;
        return carry(t, areaLights, seen, dimming, step);
    }
    // The first frame in which nothing changes begins anew: a still picture does not depend on what was
    // before.
    if (still == 1) history.casts = 0;
    const uint32_t casts = history.casts++;
    const uint32_t ray = moving ? kFirstMovingRay + step : rayNumber(in.grid, history.settling);
    const Choice choice = addChoice(t, ray, casts > 0, moving ? kRaysKnownMoving : kRaysKnown);
    const Sent sent = addRays(t, choice, in, s.reach, ray);
    const ImageHandle control = addControl(t, choice, sent.drawn, shading);
    const Means means =
        addMeans(t,
                 {.areaLights = areaLights.image,
                  .sent = sent,
                  .control = control,
                  .mostLength = moving ? float(s.movingLength) : meanLength(in.grid, s.mostLength),
                  .follows = casts > 0 && wasWhole,  // light that is late says nothing of rays' mean
                  .worldMoves = moving && worldMoves,
                  .step = step},
                 seen);
    return addCorrection(t, areaLights, means, seen, s,
                         {.fromCorrection = moving || still == 1,
                          .moving = moving,
                          .few = moving && casts > kFew ? kFewMoving : kFew,
                          .share = keptShare(in.grid),
                          .dimming = moving ? dimming : 1,
                          .step = step});
}

}  // namespace ag::gi
