#include "engine/renderer/render_settings.h"

#include <algorithm>
#include <array>

#include "engine/core/settings.h"

namespace ag::render {
namespace {

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
    s.bounce.ismAtlas = {.tileSize = 64,
                         .pointsPerMap = 2048,
                         .nearMore = false,
                         .mapping = gi::IsmMapping::kParaboloid,
                         .planes = false};
    s.bounce.valShading = {.shape = gi::ValShape::kPoint,
                           .farShape = gi::ValShape::kPoint,
                           .nearReach = 0,
                           .interleave = 3,
                           .taps = 1};
}

// 256 point lights and as many of the second bounce, 4x4 pixels share them; the edge-aware Gaussian is a
// round of the denoiser's filter over one frame.
void setSsvp(RenderSettings& s) {
    s.bounce.spacing = 1;
    s.technique = Technique::kSsvp;
    s.bounce.valClustering.count = 256;
    s.bounce.valShading = {.shape = gi::ValShape::kPoint,
                           .farShape = gi::ValShape::kPoint,
                           .nearReach = 0,
                           .interleave = 4,
                           .taps = 1};
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
    s.bounce.ismAtlas = {.tileSize = 128,
                         .pointsPerMap = 2048,
                         .nearMore = false,
                         .mapping = gi::IsmMapping::kParaboloid,
                         .planes = false};
    s.bounce.valShading.shape = gi::ValShape::kDisk;
    s.bounce.valShading.interleave = 3;
    s.bounce.valShading.taps = s.bounce.valShading.farTaps = 16;
}

// Ours by budget: lights, points a shadow map is made of, and how many pixels are gathered.
void setLow(RenderSettings& s) {
    s.bounce.valClustering.count = 64;
    s.bounce.ismAtlas = {.tileSize = 32, .pointsPerMap = 1024};
    s.bounce.spacing = 3;
}

void setAfterglow(RenderSettings&) {}

void setAfterglowBounces(RenderSettings& s) {
    s.bounce.laterBounces = {.enabled = true, .spacing = 3};
    s.bounce.valClustering.count = 256;
    s.bounce.ismAtlas.tileSize = 32;
}

void setHigh(RenderSettings& s) {
    s.bounce.valClustering.count = 256;
    s.bounce.ismAtlas = {.tileSize = 64, .pointsPerMap = 4096};
}

void setUltra(RenderSettings& s) {
    s.bounce.valClustering.count = 512;
    s.bounce.ismAtlas = {.tileSize = 128, .pointsPerMap = 8192};
    s.bounce.valShading.nearReach = 6;
    s.bounce.valShading.taps = 16;
}

// Direct light of many lamps: a shadow map each; as published; ours.
void setLightsReference(RenderSettings& s) {
    s.technique = Technique::kNone;
    s.lightClusters = {.growth = 0, .most = kMostLampClusters, .strongFirst = false, .hysteresis = 1};
    s.lampLighting = {.tiles = false, .quads = false, .shadowReach = 0};
}

void setLightCluster(RenderSettings& s) {
    s.technique = Technique::kNone;
    s.lightClusters.growth = 0.1f;
    s.lightClusters.strongFirst = false;
    s.lightClusters.hysteresis = 1;
    s.lightClusters.shareWithin = 0;
    s.lampShadows.softTaps = 12;
    s.lampLighting = {.tiles = false, .quads = false, .shadowReach = 0};
}

void setAfterglowLights(RenderSettings& s) {
    s.technique = Technique::kNone;
}

struct Preset {
    std::string_view name;
    void (*apply)(RenderSettings&);
    uint32_t mapResolution = 0;  // texels along a light map's side; 0: as each light says
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
                                              {"low", setLow, 256},
                                              {"high", setHigh, 512},
                                              {"ultra", setUltra, 1024},
                                              {"lights-reference", setLightsReference},
                                              {"lightcluster", setLightCluster},
                                              {"afterglow-lights", setAfterglowLights}}};
constexpr auto kPresetNames = [] {
    std::array<std::string_view, kPresets.size()> names;
    for (size_t i = 0; i < names.size(); ++i)
        names[i] = kPresets[i].name;
    return names;
}();

}  // namespace

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
    settings.add({"gi", "spacing", 1, 4, "pixels", "from one that indirect light is gathered at to the next"},
                 &s.bounce.spacing);
    settings.add(
        {"rsm", "resolution", 0, 1024, "texels",
         "side of a light map, rounded down to a power of two, less with many lights; 0: as each light says"},
        &s.bounce.rsm.resolution);
    settings.add({"rsm", "sun_margin", 0, 1, "", "part of the scene's width added round a sun's map"},
                 &s.bounce.rsm.sunMargin);
    settings.add(
        {"importance", "view_weight", 0, 1, "", "seed clusters by flux (0) or by what faces the view (1)"},
        &s.bounce.importance.viewWeight);
    settings.add({"val_clustering", "count", 16, 1024, "clusters", "clusters over all bounce lights"},
                 &s.bounce.valClustering.count);
    settings.add({"val_clustering", "distance_weight", 0, 1000, "1/m2", "metric: squared distance"},
                 &s.bounce.valClustering.distanceWeight);
    settings.add({"val_clustering", "normal_weight", 0, 1000, "", "metric: 1 - cosine of the normals"},
                 &s.bounce.valClustering.normalWeight);
    settings.add(
        {"val_clustering", "chroma_weight", 0, 1000, "", "metric: squared difference of flux colour"},
        &s.bounce.valClustering.chromaWeight);
    settings.add(
        {"val_clustering", "plane_weight", 0, 1000, "1/m2", "metric: squared distance from the plane"},
        &s.bounce.valClustering.planeWeight);
    settings.add(
        {"val_clustering", "adaptive", 0, 0, "", "split clusters with much error, drop those with little"},
        &s.bounce.valClustering.adaptive);
    settings.add({"val_clustering", "settle_frames", 0, 1000, "frames",
                  "clustering steps after the light maps last changed"},
                 &s.bounce.valClustering.settleFrames);
    settings.add({"val_shading",
                  "shape",
                  0,
                  0,
                  "",
                  "form factor of a near area light",
                  {"point", "disk", "vector_disk", "rectangle", "polygon"}},
                 &s.bounce.valShading.shape);
    settings.add({"val_shading",
                  "far_shape",
                  0,
                  0,
                  "",
                  "form factor of a far area light",
                  {"point", "disk", "vector_disk", "rectangle", "polygon"}},
                 &s.bounce.valShading.farShape);
    settings.add({"val_shading", "near_reach", 0, 1e6, "half lengths",
                  "lights nearer to a screen tile than this are met by each of its pixels; 0: none"},
                 &s.bounce.valShading.nearReach);
    settings.add({"val_shading", "interleave", 1, 4, "pixels",
                  "blocks of n x n pixels share the far lights, each pixel meets a part of them"},
                 &s.bounce.valShading.interleave);
    settings.add({"ism_atlas", "enabled", 0, 0, "", "visibility of indirect light"},
                 &s.bounce.ismAtlas.enabled);
    settings.add({"ism_atlas", "tile_size", 16, 128, "texels",
                  "side of a light's depth map, rounded down to a multiple of 16"},
                 &s.bounce.ismAtlas.tileSize);
    settings.add({"ism_atlas", "points_per_map", 64, 131072, "points", "splatted into each depth map"},
                 &s.bounce.ismAtlas.pointsPerMap);
    settings.add(
        {"ism_atlas", "near_more", 0, 0, "", "more points from surfaces near the light, fewer far off"},
        &s.bounce.ismAtlas.nearMore);
    settings.add(
        {"ism_atlas", "splat_scale", 0.1, 10, "", "of the points' disks; at 1 they have the surfaces' area"},
        &s.bounce.ismAtlas.splatScale);
    settings.add(
        {"ism_atlas", "mapping", 0, 0, "", "of the hemisphere to a square", {"octahedral", "paraboloid"}},
        &s.bounce.ismAtlas.mapping);
    settings.add(
        {"ism_atlas", "planes", 0, 0, "", "texels keep planes; off: distances with a bias of a disk"},
        &s.bounce.ismAtlas.planes);
    settings.add({"ism_atlas", "keep_maps", 0, 0, "", "do not splat again for lights that stand still"},
                 &s.bounce.ismAtlas.keepMaps);
    settings.add({"ism_atlas", "pull_push", 0, 0, "", "close the holes between points"},
                 &s.bounce.ismAtlas.pullPush);
    settings.add(
        {"refresh", "light_frames", 1, 64, "frames",
         "while only small things move, from one time that lights are clustered to the next; 1: always"},
        &s.bounce.refresh.lightFrames);
    settings.add({"refresh", "pixel_frames", 1, 16, "frames",
                  "in which all pixels are gathered meanwhile that are as they were"},
                 &s.bounce.refresh.pixelFrames);
    settings.add({"refresh", "small", 0, 1, "", "of what the camera or a light sees, what counts as small"},
                 &s.bounce.refresh.small);
    settings.add({"ssvp", "clusters", 1, 64, "clusters", "of point lights, each with a paraboloid map"},
                 &s.ssvp.clusters);
    settings.add({"ssvp", "second_count", 0, 4096, "lights", "of the second bounce"}, &s.ssvp.secondCount);
    settings.add({"ssvp", "rounds", 1, 20, "rounds", "of k-means a frame"}, &s.ssvp.rounds);
    settings.add({"ssvp", "map_size", 16, 512, "texels", "side of a paraboloid's square, a multiple of 16"},
                 &s.ssvp.mapSize);
    settings.add({"ssvp", "disk", 0, 0, "", "sample the paraboloids' disks; off: the squares round them"},
                 &s.ssvp.disk);
    settings.add({"later_bounces", "enabled", 0, 0, "", "light goes on after its first bounce"},
                 &s.bounce.laterBounces.enabled);
    settings.add({"later_bounces", "feedback", 0, 0, "", "and after its second; off: no more than two"},
                 &s.bounce.laterBounces.feedback);
    settings.add({"later_bounces", "share", 0.05, 0.8, "", "of all clusters"}, &s.bounce.laterBounces.share);
    settings.add({"later_bounces", "spacing", 1, 4, "pixels",
                  "of those bounced light is gathered at, to those later bounces are"},
                 &s.bounce.laterBounces.spacing);
    settings.add({"later_bounces", "settle_frames", 1, 1000000, "frames",
                  "light goes on bouncing after anything last changed"},
                 &s.bounce.laterBounces.settleFrames);
    settings.add({"val_shading", "taps", 1, 64, "taps", "of near lights' soft shadows; 1: hard ones"},
                 &s.bounce.valShading.taps);
    settings.add({"val_shading", "far_taps", 1, 64, "taps", "of far lights' soft shadows; 1: hard ones"},
                 &s.bounce.valShading.farTaps);
    settings.add({"val_shading", "glossy", 0, 0, "",
                  "area lights shine on materials by their roughness; off: all are Lambert"},
                 &s.bounce.valShading.glossy);
    settings.add({"stochastic_rsm", "samples", 1, 4096, "samples", "of each light map, a pixel"},
                 &s.bounce.stochasticRsm.samples);
    settings.add({"stochastic_rsm", "radius", 0.001, 2, "map widths",
                  "of the disk about the pixel's projection; light beyond it is lost"},
                 &s.bounce.stochasticRsm.radius);
    settings.add({"stochastic_rsm", "interpolate", 0, 0, "",
                  "gather a 16th of the pixels, blend where surfaces are alike"},
                 &s.bounce.stochasticRsm.interpolate);
    settings.add(
        {"stochastic_rsm", "random", 0, 0, "", "other samples in each pixel and frame, for the denoiser"},
        &s.bounce.stochasticRsm.random);
    settings.add({"stochastic_rsm", "whole", 0, 0, "",
                  "every other sample from all of the map, so that no light is lost"},
                 &s.bounce.stochasticRsm.whole);
    settings.add({"stochastic_rsm", "visible", 0, 0, "",
                  "samples as far as their cluster's imperfect shadow map lets them be seen"},
                 &s.bounce.stochasticRsm.visible);
    settings.add({"stochastic_rsm", "settle_frames", 0, 1000000, "frames",
                  "with new samples after anything last changed"},
                 &s.bounce.stochasticRsm.settleFrames);
    settings.add({"denoiser", "enabled", 0, 0, "", "steady and smooth indirect light over frames and screen"},
                 &s.bounce.denoiser.enabled);
    settings.add({"denoiser", "least_share", 0.001, 1, "", "of a new frame in the mean"},
                 &s.bounce.denoiser.leastShare);
    settings.add({"denoiser", "most_length", 1, 2048, "frames", "a history stands for"},
                 &s.bounce.denoiser.mostLength);
    settings.add({"denoiser", "rounds", 0, 5, "rounds", "of the filter, each twice as wide"},
                 &s.bounce.denoiser.rounds);
    settings.add({"denoiser", "separable", 0, 0, "", "filter along two lines instead of over a square"},
                 &s.bounce.denoiser.separable);
    settings.add({"denoiser", "recurrent", 0, 0, "", "the filter's first round goes into the history"},
                 &s.bounce.denoiser.recurrent);
    settings.add({"denoiser", "adaptive", 0, 0, "", "changing light takes over, bright samples are spread"},
                 &s.bounce.denoiser.adaptive);
    settings.add({"denoiser", "motion", 0, 0, "", "histories follow what moves"}, &s.bounce.denoiser.motion);
    settings.add({"denoiser", "light_tolerance", 0, 1000, "deviations",
                  "by which the light of taps may differ; 0: any"},
                 &s.bounce.denoiser.lightTolerance);
    settings.add({"shadow_maps", "resolution", 64, 4096, "texels", "side of a sun's cascade"},
                 &s.shadowMaps.resolution);
    settings.add({"shadow_maps", "cascades", 1, 4, "", "cascades of a sun"}, &s.shadowMaps.cascades);
    settings.add({"shadow_maps", "cascade_reach", 0.001, 1, "",
                  "part of the way to the scene's end that cascades share out; the last one goes on to it"},
                 &s.shadowMaps.cascadeReach);
    settings.add({"shadow_maps", "cascade_split", 0, 1, "", "0 uniform, 1 logarithmic"},
                 &s.shadowMaps.cascadeSplit);
    settings.add(
        {"light_clusters", "most", 0, kMostLampClusters, "clusters", "of lamps, each with a shadow map"},
        &s.lightClusters.most);
    settings.add(
        {"light_clusters", "growth", 0, 10, "", "m between clusters' centres for each m to the camera"},
        &s.lightClusters.growth);
    settings.add({"light_clusters", "strong_first", 0, 0, "",
                  "lamps that matter keep a shadow map of their own longer"},
                 &s.lightClusters.strongFirst);
    settings.add(
        {"light_clusters", "hysteresis", 0, 1, "", "part of the distance that a centre of before needs"},
        &s.lightClusters.hysteresis);
    settings.add({"light_clusters", "share_within", 0, 100, "",
                  "part of its range that a lamp may be from the centre whose shadow it shares; 0: no limit"},
                 &s.lightClusters.shareWithin);
    settings.add({"lamp_shadows", "face_resolution", 16, 2048, "texels",
                  "side of a cube's face, at most; a spot's map has twice"},
                 &s.lampShadows.faceResolution);
    settings.add({"lamp_shadows", "atlas_size", 256, 16384, "texels", "side of the atlas"},
                 &s.lampShadows.atlasSize);
    settings.add({"lamp_shadows", "soft_taps", 0, 64, "taps",
                  "of a disk as large as a cluster, for its shadow; 0: from its centre"},
                 &s.lampShadows.softTaps);
    settings.add({"probes", "taps", 1, 32, "", "of area lights' soft shadows at probes"},
                 &s.bounce.probes.taps);
    settings.add({"lamp_lighting", "tiles", 0, 0, "", "pixels meet only lamps that reach their tile"},
                 &s.lampLighting.tiles);
    settings.add(
        {"lamp_lighting", "shadow_reach", 0, 100, "",
         "times a lamp's distance from its cluster's centre, from where on it has all of its shadow"},
        &s.lampLighting.shadowReach);
    settings.add({"lamp_lighting", "quads", 0, 0, "", "shadows at one pixel of each 2 x 2"},
                 &s.lampLighting.quads);
    settings.add({"composite", "exposure", -20, 20, "stops", "of the display image"}, &s.composite.exposure);
    settings.add(
        {"composite", "tonemap", 0, 0, "", "curve of the display image", {"none", "reinhard", "aces"}},
        &s.composite.tonemap);
}

}  // namespace ag::render
