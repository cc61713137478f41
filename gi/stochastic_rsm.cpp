#include "gi/stochastic_rsm.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "common/sampling.h"
#include "engine/core/hash.h"
#include "gi/blue_noise.h"
#include "gi/pixel_list.h"

namespace ag::gi {
namespace {

constexpr uint32_t kCoarseStep = 4;      // pixels
constexpr uint32_t kMostSamples = 4096;  // what one upload holds

// Pass names are literals, because the graph keeps views of them.
constexpr std::array<std::string_view, io::kMaxBounceLights> kGatherNames = {
    "stochastic_rsm.gather0", "stochastic_rsm.gather1", "stochastic_rsm.gather2", "stochastic_rsm.gather3",
    "stochastic_rsm.gather4", "stochastic_rsm.gather5", "stochastic_rsm.gather6", "stochastic_rsm.gather7"};
constexpr std::array<std::string_view, io::kMaxBounceLights> kListedNames = {
    "stochastic_rsm.listed0", "stochastic_rsm.listed1", "stochastic_rsm.listed2", "stochastic_rsm.listed3",
    "stochastic_rsm.listed4", "stochastic_rsm.listed5", "stochastic_rsm.listed6", "stochastic_rsm.listed7"};

constexpr PixelListNames kList = {"stochastic_rsm.list", "stochastic_rsm.empty_list", "stochastic_rsm.groups",
                                  "stochastic_rsm.no_groups"};

// Directions and radii in the unit disk, dense in its middle. Samples that take turns between disk and whole
// map are two patterns.
BufferHandle addPattern(GraphScope scope, uint32_t samples, bool takeTurns) {
    std::array<glm::vec4, kMostSamples> points;  // 64 KiB
    for (uint32_t i = 0; i < samples; ++i) {
        const glm::vec2 xi =
            takeTurns ? io::hammersley(i / 2, (samples + 1) / 2) : io::hammersley(i, samples);
        const float angle = 2 * std::numbers::pi_v<float> * xi.y;
        points[i] = {std::cos(angle), std::sin(angle), xi.x, xi.y};
    }
    const auto bytes = std::as_bytes(std::span(points.data(), samples));
    const BufferHandle buffer = scope.buffer(
        "stochastic_rsm.pattern", {.sizeBytes = bytes.size(), .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT});
    scope.upload("stochastic_rsm.pattern", buffer, bytes);
    return buffer;
}

// Frames are spread evenly as well: multiples of the plastic number's inverse powers (Roberts 2018).
glm::vec2 shiftOf(uint32_t step) {
    return glm::vec2(glm::fract(double(step) * glm::dvec2(0.7548776662466927, 0.5698402909980532)));
}

struct Inputs {
    const Surfaces& gbuffer;
    const RsmSet& rsm;
    const SampledRsm& of;
    BufferHandle pattern, noise;
    PixelList list;
    glm::vec2 shift{0};
    const StochasticRsmSettings& settings;
};

struct GatherTo {
    ImageHandle image;
    uint32_t step = 1;    // pixels from one that is gathered to the next
    bool listed = false;  // only at listed pixels
    bool add = false;     // on top of what the image holds
};

// One pass a map.
PassBuilder addGather(GraphScope scope, std::string_view name, const Inputs& in, uint32_t map,
                      const GatherTo& to) {
    const IsmAtlas& isms = in.of.lights.isms;
    const bool visible = in.settings.visible && bool(isms.planes);
    PassBuilder pass = scope.compute(
        name, visible ? "stochastic_rsm/gather_visible_samples.comp" : "stochastic_rsm/gather_samples.comp");
    if (visible)
        pass.read("slotOfTexel", in.of.clusters.slotOfTexel)
            .read("candidates", in.of.clusters.candidates)
            .read("vals", in.of.lights.vals.vals)
            .read("isms", isms.planes)
            .constant("kParaboloid", isms.mapping == IsmMapping::kParaboloid);
    pass.sample("normalMap", in.gbuffer.normal)
        .sample("depthMap", in.gbuffer.depth)
        .read("camera", in.gbuffer.camera)
        .read("texels", in.rsm.texels)
        .read("faces", in.rsm.faces)
        .read("maps", in.rsm.maps)
        .read("pattern", in.pattern)
        .read("list", in.list.pixels)
        .read("noise", in.noise)
        .constant("kRandom", in.settings.random)
        .constant("kWhole", in.settings.whole)
        .constant("kKind", in.rsm.mapInfo[map].kind)
        .constant("kListed", to.listed)
        .constant("kFirst", !to.add)
        .push(io::StochasticRsmPush{.map = map,
                                    .sampleCount = in.settings.samples,
                                    .radius = in.settings.radius,
                                    .step = to.step,
                                    .atlasWidth = in.rsm.atlas.size.x,
                                    .shift = in.shift,
                                    .ismTileSize = isms.tileSize});
    if (to.add)
        pass.readWrite("irradiance", to.image);
    else
        pass.write("irradiance", to.image);
    return pass;
}

// Blends the coarse image into `image` and lists the pixels that must be gathered.
void addInterpolation(GraphScope scope, const Inputs& in, ImageHandle coarse, ImageHandle image) {
    scope.compute("stochastic_rsm.interpolate", "stochastic_rsm/interpolate_samples.comp")
        .sample("normalMap", in.gbuffer.normal)
        .sample("depthMap", in.gbuffer.depth)
        .read("camera", in.gbuffer.camera)
        .sample("coarse", coarse)
        .readWrite("listed", in.list.pixels)
        .readWrite("listedGroups", in.list.groups)
        .write("irradiance", image)
        .push(io::RsmInterpolationPush{.step = kCoarseStep, .leastCosine = 0.95f, .mostPlaneShare = 0.01f})
        .dispatchThreads(in.gbuffer.size.x, in.gbuffer.size.y);
}

}  // namespace

Irradiance addStochasticRsm(GraphScope scope, const Versions& versions, const Surfaces& gbuffer,
                            const SampledRsm& of, const StochasticRsmSettings& settings, Settling& settling) {
    const RsmSet& rsm = of.rsm;
    if (rsm.empty()) return {};
    const VkFormat format = VK_FORMAT_R16G16B16A16_SFLOAT;
    const Irradiance result{
        scope.image("stochastic_rsm.irradiance", {.format = format, .size = gbuffer.size})};
    const uint64_t seen = combineHash(rsm.inputsVersion, combineHash(versions.camera, versions.instances));
    const uint32_t step = settings.random ? settling.advance(seen, settings.settleFrames) : 0;
    const Inputs in{.gbuffer = gbuffer,
                    .rsm = rsm,
                    .of = of,
                    .pattern = addPattern(scope, settings.samples, settings.whole),
                    .noise = addBlueNoise(scope),
                    .list = addPixelList(scope, kList, settings.interpolate ? gbuffer.size : glm::uvec2(0)),
                    .shift = shiftOf(step),
                    .settings = settings};

    if (!settings.interpolate) {
        for (uint32_t m = 0; m < rsm.lightRsmCount; ++m)
            addGather(scope, kGatherNames[m], in, m, {.image = result.image, .add = m > 0})
                .dispatchThreads(gbuffer.size.x * gbuffer.size.y);
        return result;
    }
    const glm::uvec2 coarseSize = (gbuffer.size + kCoarseStep - 1u) / kCoarseStep;
    const ImageHandle coarse = scope.image("stochastic_rsm.coarse", {.format = format, .size = coarseSize});
    for (uint32_t m = 0; m < rsm.lightRsmCount; ++m)
        addGather(scope, kGatherNames[m], in, m, {.image = coarse, .step = kCoarseStep, .add = m > 0})
            .dispatchThreads(coarseSize.x * coarseSize.y);
    addInterpolation(scope, in, coarse, result.image);
    for (uint32_t m = 0; m < rsm.lightRsmCount; ++m)
        addGather(scope, kListedNames[m], in, m, {.image = result.image, .listed = true, .add = true})
            .dispatchIndirect(in.list.groups);
    return result;
}

}  // namespace ag::gi
