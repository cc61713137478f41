#include "engine/renderer/render_settings.h"

#include <algorithm>
#include <array>

#include "engine/core/settings.h"
#include "shaders/shadow_maps/shadow_maps_io.h"

namespace ag::render {
namespace {

constexpr uint32_t kMostLightsOfBounces = 512;  // that are doubled to

void setNone(RenderSettings& s) {
    s.technique = Technique::kNone;
}

void setRsmBrute(RenderSettings& s) {
    s.bounce.spacing = 1;
    s.technique = Technique::kRsmBrute;
}

void setRsm400(RenderSettings& s) {
    s.bounce.spacing = 1;
    s.technique = Technique::kRsm400;
    s.bounce.stochasticRsm = {.samples = 400, .radius = 0.3f};
}

// Eight samples and the article's denoiser; ours.
void setIrsm(RenderSettings& s) {
    s.bounce.spacing = 1;
    s.technique = Technique::kIrsm;
    s.bounce.stochasticRsm = {.samples = 8, .radius = 0.3f, .random = true};
    s.bounce.denoiser = {.enabled = true,
                         .leastShare = 0.05f,
                         .rounds = 5,
                         .recurrent = true,
                         .adaptive = false,
                         .lightTolerance = 0};
}

void setStochastic(RenderSettings& s) {
    s.technique = Technique::kStochastic;
    s.bounce.stochasticRsm = {.samples = 8, .random = true, .whole = true, .visible = true};
    s.bounce.denoiser = {.enabled = true, .rounds = 2};
}

// Point lights with hard shadows out of uniform points; distances in paraboloids of the atlas's full size.
void setIsm(RenderSettings& s) {
    s.bounce.spacing = 1;
    s.technique = Technique::kIsm;
    s.bounce.importance.viewWeight = 0;
    s.bounce.valClustering.count = 1024;
    s.bounce.ismAtlas = {.traced = false,
                         .tileSize = 64,
                         .pointsPerMap = 2048,
                         .nearMore = false,
                         .mapping = gi::IsmMapping::kParaboloid,
                         .planes = false};
    s.bounce.valShading = {
        .shape = gi::ValShape::kPoint, .farShape = gi::ValShape::kPoint, .nearReach = 0, .taps = 1};
}

// 256 point lights and as many of the second bounce, 4x4 pixels share them; the edge-aware Gaussian is a
// round of the denoiser's filter over one frame.
void setSsvp(RenderSettings& s) {
    s.bounce.spacing = 1;
    s.technique = Technique::kSsvp;
    s.bounce.valClustering.count = 256;
    s.bounce.valShading = {
        .shape = gi::ValShape::kPoint, .farShape = gi::ValShape::kPoint, .nearReach = 0, .taps = 1};
    s.bounce.denoiser = {.enabled = true,
                         .leastShare = 1,
                         .rounds = 1,
                         .separable = false,
                         .adaptive = false,
                         .motion = false,
                         .lightTolerance = 0};
    s.composite.tonemap = Tonemap::kReinhard;
}

void setRsmc(RenderSettings& s) {
    s.technique = Technique::kRsmc;
    s.bounce.spacing = 1;
    s.bounce.ismAtlas.enabled = false;
    s.bounce.valShading.farShape = gi::ValShape::kDisk;
    s.bounce.valShading.nearReach = 0;
    s.bounce.valClustering.adaptive = false;
    s.bounce.importance.viewWeight = 1;  // the geometry term toward the view alone
    s.bounce.valClustering.distanceWeight = s.bounce.valClustering.normalWeight = 1;
    s.bounce.valClustering.chromaWeight = 10;
    s.bounce.valClustering.planeWeight = 0;
}

void setAcrsm(RenderSettings& s) {
    setRsmc(s);
    s.technique = Technique::kAcrsm;
    s.bounce.importance.viewWeight = 0.5f;
    s.bounce.valClustering.adaptive = true;
    s.bounce.valClustering.count = 512;
    s.bounce.ismAtlas = {.traced = false,
                         .tileSize = 128,
                         .pointsPerMap = 2048,
                         .nearMore = false,
                         .mapping = gi::IsmMapping::kParaboloid,
                         .planes = false};
    s.bounce.valShading.shape = gi::ValShape::kDisk;
    s.bounce.valShading.taps = s.bounce.valShading.farTaps = 16;
}

// Ours by budget: lights, points a shadow map is made of, and how many pixels are gathered.
void setLow(RenderSettings& s) {
    gi::applyQuality("low", s.bounce);
}

void setAfterglow(RenderSettings&) {}

void setAfterglowBounces(RenderSettings& s) {
    addBounces(s);
}

void setHigh(RenderSettings& s) {
    gi::applyQuality("high", s.bounce);
}

void setUltra(RenderSettings& s) {
    gi::applyQuality("ultra", s.bounce);
}

// Direct light of many punctual lights: a shadow map each; as published; ours.
void setLightsReference(RenderSettings& s) {
    s.technique = Technique::kNone;
    s.lightClusters = {.growth = 0, .most = kMostLightClusters, .strongFirst = false, .hysteresis = 1};
    s.punctualLighting = {.tiles = false, .quads = false, .shadowReach = 0};
}

void setLightCluster(RenderSettings& s) {
    s.technique = Technique::kNone;
    s.lightClusters.growth = 0.1f;
    s.lightClusters.strongFirst = false;
    s.lightClusters.hysteresis = 1;
    s.lightClusters.shareWithin = 0;
    s.punctualShadows.softTaps = 12;
    s.punctualLighting = {.tiles = false, .quads = false, .shadowReach = 0};
}

void setAfterglowLights(RenderSettings& s) {
    s.technique = Technique::kNone;
}

struct Preset {
    std::string_view name;
    void (*apply)(RenderSettings&);
    uint32_t mapResolution = 0;  // texels along an RSM's side; 0: as each light says
    bool waits = true;           // with what may be late; not where a published system is compared with
};

constexpr std::array<Preset, 18> kPresets = {{{"none", setNone},
                                              {"rsm-brute", setRsmBrute, 128, false},
                                              {"rsm-400", setRsm400, 256, false},
                                              {"irsm", setIrsm, 256, false},
                                              {"stochastic", setStochastic, 256},
                                              {"ism", setIsm, 256, false},
                                              {"ssvp", setSsvp, 256, false},
                                              {"rsmc", setRsmc, 256, false},
                                              {"acrsm", setAcrsm, 256, false},
                                              {"afterglow", setAfterglow},
                                              {"medium", setAfterglow},
                                              {"afterglow-bounces", setAfterglowBounces, 256},
                                              {"low", setLow},
                                              {"high", setHigh},
                                              {"ultra", setUltra},
                                              {"lights-reference", setLightsReference},
                                              {"lightcluster", setLightCluster},
                                              {"afterglow-lights", setAfterglowLights}}};
constexpr auto kPresetNames = [] {
    std::array<std::string_view, kPresets.size()> names;
    for (size_t i = 0; i < names.size(); ++i)
        names[i] = kPresets[i].name;
    return names;
}();

// Whether rays go from points to lights that have no RSM.
bool castsRaysToLights(const RenderSettings& s, const RenderScene& scene) {
    if (s.technique != Technique::kAreaLights || !s.bounce.laterBounces.enabled) return false;
    return std::ranges::any_of(scene.lights, [](const RenderLight& l) { return l.reflects && !l.bounces; });
}

}  // namespace

void addBounces(RenderSettings& s) {
    gi::BounceLightSettings& b = s.bounce;
    b.laterBounces = {.enabled = true, .spacing = 3};
    if (b.valClustering.count < kMostLightsOfBounces / 2)
        b.ismAtlas.tileSize = std::min(b.ismAtlas.tileSize, 32u);
    b.valClustering.count =
        std::max(std::min(2 * b.valClustering.count, kMostLightsOfBounces), b.valClustering.count);
}

std::span<const std::string_view> presetNames() {
    return kPresetNames;
}

bool applyPreset(std::string_view name, RenderSettings& s) {
    const auto found = std::ranges::find(kPresets, name, &Preset::name);
    if (found == kPresets.end()) return false;
    found->apply(s);
    if (found->mapResolution) s.bounce.rsm.resolution = found->mapResolution;
    if (!found->waits) s.bounce.refresh.lightFrames = 1;
    return true;
}

bool castsTexelRays(const RenderSettings& s) {
    return s.technique == Technique::kAreaLights && s.bounce.texelRays.enabled;
}

std::optional<gi::TracedBy> tracedBy(const RenderSettings& s, const RenderScene& scene) {
    constexpr std::array kWithMaps = {Technique::kAreaLights, Technique::kStochastic, Technique::kIsm,
                                      Technique::kRsmc, Technique::kAcrsm};
    const bool sky = scene.sky && s.bounce.sky.enabled;
    if (sky || castsRaysToLights(s, scene)) return gi::TracedBy{gi::TreesOf::kAll};
    const bool probes =
        s.technique == Technique::kAreaLights && !scene.probes.empty() && s.bounce.probes.rays > 0;
    if (castsTexelRays(s) || probes)
        return gi::TracedBy{.of = gi::TreesOf::kAll,
                            .atRest = s.bounce.texelRays.movingLength == 0 && !probes};
    const bool maps = s.bounce.ismAtlas.enabled && s.bounce.ismAtlas.traced;
    if (maps && std::ranges::count(kWithMaps, s.technique) > 0) return gi::TracedBy{gi::TreesOf::kStatic};
    return {};
}

void fitToDevice(const VkPhysicalDeviceLimits& limits, RenderSettings& s) {
    constexpr uint32_t kAtlasColumns = 4;  // of views of kMaxShadowViews
    static_assert(kAtlasColumns * kAtlasColumns == io::kMaxShadowViews);
    const uint32_t side = limits.maxImageDimension2D;
    s.shadowMaps.resolution = std::min(s.shadowMaps.resolution, side / kAtlasColumns);
    s.punctualShadows.atlasSize = std::min(s.punctualShadows.atlasSize, side);
}

void registerSettings(Settings& settings, RenderSettings& s) {
    settings.add({"gi",
                  "technique",
                  0,
                  0,
                  "",
                  "how indirect light is made; presets set what goes with each",
                  {"none", "area_lights", "stochastic", "rsm_brute", "rsm_400", "irsm", "ism", "rsmc",
                   "acrsm", "ssvp"}},
                 &s.technique);
    gi::registerSettings(settings, s.bounce);
    registerFields(settings, "ssvp", s.ssvp);
    registerFields(settings, "interleaved_shading", s.interleavedShading);
    registerFields(settings, "shadow_maps", s.shadowMaps);
    registerFields(settings, "light_clusters", s.lightClusters);
    registerFields(settings, "punctual_shadows", s.punctualShadows);
    registerFields(settings, "punctual_lighting", s.punctualLighting);
    registerFields(settings, "reflections", s.reflections);
    registerFields(settings, "blending", s.blending);
    registerFields(settings, "antialiasing", s.antialiasing);
    registerFields(settings, "bloom", s.bloom);
    registerFields(settings, "composite", s.composite);
    registerFields(settings, "exposure", s.exposure);
}

}  // namespace ag::render
