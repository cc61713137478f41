#include "gi/gi_settings.h"

#include <algorithm>
#include <array>

#include "engine/core/settings.h"

namespace ag::gi {
namespace {

void setNone(GiSettings& gi) {
    gi.firstBounce = FirstBounce::kNone;
}

void setRsmBrute(GiSettings& gi) {
    gi.spacing = 1;
    gi.firstBounce = FirstBounce::kTexels;
}

void setRsm400(GiSettings& gi) {
    gi.spacing = 1;
    gi.firstBounce = FirstBounce::kStochasticRsm;
    gi.stochasticRsm = {.samples = 400, .radius = 0.3f};
}

// Eight samples and the article's denoiser; ours.
void setIrsm(GiSettings& gi) {
    gi.spacing = 1;
    gi.firstBounce = FirstBounce::kStochasticRsm;
    gi.stochasticRsm = {.samples = 8, .radius = 0.3f, .random = true};
    gi.denoiser = {.enabled = true,
                   .leastShare = 0.05f,
                   .rounds = 5,
                   .recurrent = true,
                   .adaptive = false,
                   .lightTolerance = 0};
}

void setStochastic(GiSettings& gi) {
    gi.firstBounce = FirstBounce::kStochasticRsm;
    gi.stochasticRsm = {.samples = 8, .random = true, .whole = true, .visible = true};
    gi.denoiser = {.enabled = true, .rounds = 2};
}

// Point lights with hard shadows out of uniform points; distances in paraboloids of the atlas's full size.
void setIsm(GiSettings& gi) {
    gi.spacing = 1;
    gi.firstBounce = FirstBounce::kPointLights;
    gi.importance.viewWeight = 0;
    gi.valClustering.count = 1024;
    gi.ismAtlas = {.tileSize = 64,
                   .pointsPerMap = 2048,
                   .nearMore = false,
                   .mapping = IsmMapping::kParaboloid,
                   .planes = false};
    gi.valShading = {
        .shape = ValShape::kPoint, .farShape = ValShape::kPoint, .nearReach = 0, .interleave = 3, .taps = 1};
}

// 256 point lights and as many of the second bounce, 4x4 pixels share them; the edge-aware Gaussian is a
// round of the denoiser's filter over one frame.
void setSsvp(GiSettings& gi) {
    gi.spacing = 1;
    gi.firstBounce = FirstBounce::kSsvp;
    gi.valClustering.count = 256;
    gi.valShading = {
        .shape = ValShape::kPoint, .farShape = ValShape::kPoint, .nearReach = 0, .interleave = 4, .taps = 1};
    gi.denoiser = {.enabled = true,
                   .leastShare = 1,
                   .rounds = 1,
                   .separable = false,
                   .adaptive = false,
                   .motion = false,
                   .lightTolerance = 0};
    gi.composite.tonemap = Tonemap::kReinhard;
}

void setRsmc(GiSettings& gi) {
    gi.spacing = 1;
    gi.ismAtlas.enabled = false;
    gi.valShading.farShape = ValShape::kDisk;
    gi.valShading.nearReach = 0;
    gi.valClustering.adaptive = false;
    gi.importance.viewWeight = 1;  // the geometry term toward the view alone
    gi.valClustering.distanceWeight = gi.valClustering.normalWeight = 1;
    gi.valClustering.chromaWeight = 10;
    gi.valClustering.planeWeight = 0;
}

void setAcrsm(GiSettings& gi) {
    setRsmc(gi);
    gi.importance.viewWeight = 0.5f;
    gi.valClustering.adaptive = true;
    gi.valClustering.count = 512;
    gi.ismAtlas = {.tileSize = 128,
                   .pointsPerMap = 2048,
                   .nearMore = false,
                   .mapping = IsmMapping::kParaboloid,
                   .planes = false};
    gi.valShading.shape = ValShape::kDisk;
    gi.valShading.interleave = 3;
    gi.valShading.taps = gi.valShading.farTaps = 16;
}

// Ours by budget: lights, points a shadow map is made of, and how many pixels are gathered.
void setLow(GiSettings& gi) {
    gi.valClustering.count = 64;
    gi.ismAtlas = {.tileSize = 32, .pointsPerMap = 1024};
    gi.spacing = 3;
}

void setAfterglow(GiSettings&) {}

void setAfterglowBounces(GiSettings& gi) {
    gi.laterBounces = {.enabled = true, .spacing = 3};
    gi.valClustering.count = 256;
    gi.ismAtlas.tileSize = 32;
}

void setHigh(GiSettings& gi) {
    gi.valClustering.count = 256;
    gi.ismAtlas = {.tileSize = 64, .pointsPerMap = 4096};
}

void setUltra(GiSettings& gi) {
    gi.valClustering.count = 512;
    gi.ismAtlas = {.tileSize = 128, .pointsPerMap = 8192};
    gi.valShading.nearReach = 6;
    gi.valShading.taps = 16;
}

// Direct light of many lamps: a shadow map each; as published; ours.
void setLightsReference(GiSettings& gi) {
    gi.firstBounce = FirstBounce::kNone;
    gi.lightClusters = {.growth = 0, .most = kMostLampClusters, .strongFirst = false, .hysteresis = 1};
    gi.lampLighting = {.tiles = false, .quads = false, .shadowReach = 0};
}

void setLightCluster(GiSettings& gi) {
    gi.firstBounce = FirstBounce::kNone;
    gi.lightClusters.growth = 0.1f;
    gi.lightClusters.strongFirst = false;
    gi.lightClusters.hysteresis = 1;
    gi.lightClusters.shareWithin = 0;
    gi.lampShadows.softTaps = 12;
    gi.lampLighting = {.tiles = false, .quads = false, .shadowReach = 0};
}

void setAfterglowLights(GiSettings& gi) {
    gi.firstBounce = FirstBounce::kNone;
}

struct Preset {
    std::string_view name;
    void (*apply)(GiSettings&);
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

bool applyPreset(std::string_view name, GiSettings& gi) {
    const auto found = std::ranges::find(kPresets, name, &Preset::name);
    if (found == kPresets.end()) return false;
    found->apply(gi);
    if (found->mapResolution) gi.rsm.resolution = found->mapResolution;
    if (!found->waits) gi.refresh.lightFrames = 1;
    return true;
}

void registerSettings(Settings& s, GiSettings& gi) {
    s.add({"gi",
           "first_bounce",
           0,
           0,
           "",
           "where indirect light comes from",
           {"none", "area_lights", "point_lights", "texels", "stochastic_rsm", "ssvp"}},
          &gi.firstBounce);
    s.add({"gi", "spacing", 1, 4, "pixels", "from one that indirect light is gathered at to the next"},
          &gi.spacing);
    s.add(
        {"rsm", "resolution", 0, 1024, "texels",
         "side of a light map, rounded down to a power of two, less with many lights; 0: as each light says"},
        &gi.rsm.resolution);
    s.add({"rsm", "sun_margin", 0, 1, "", "part of the scene's width added round a sun's map"},
          &gi.rsm.sunMargin);
    s.add({"importance", "view_weight", 0, 1, "", "seed clusters by flux (0) or by what faces the view (1)"},
          &gi.importance.viewWeight);
    s.add({"val_clustering", "count", 16, 1024, "clusters", "clusters over all bounce lights"},
          &gi.valClustering.count);
    s.add({"val_clustering", "distance_weight", 0, 1000, "1/m2", "metric: squared distance"},
          &gi.valClustering.distanceWeight);
    s.add({"val_clustering", "normal_weight", 0, 1000, "", "metric: 1 - cosine of the normals"},
          &gi.valClustering.normalWeight);
    s.add({"val_clustering", "chroma_weight", 0, 1000, "", "metric: squared difference of flux colour"},
          &gi.valClustering.chromaWeight);
    s.add({"val_clustering", "plane_weight", 0, 1000, "1/m2", "metric: squared distance from the plane"},
          &gi.valClustering.planeWeight);
    s.add({"val_clustering", "adaptive", 0, 0, "", "split clusters with much error, drop those with little"},
          &gi.valClustering.adaptive);
    s.add({"val_clustering", "settle_frames", 0, 1000, "frames",
           "clustering steps after the light maps last changed"},
          &gi.valClustering.settleFrames);
    s.add({"val_shading",
           "shape",
           0,
           0,
           "",
           "form factor of a near area light",
           {"point", "disk", "vector_disk", "rectangle", "polygon"}},
          &gi.valShading.shape);
    s.add({"val_shading",
           "far_shape",
           0,
           0,
           "",
           "form factor of a far area light",
           {"point", "disk", "vector_disk", "rectangle", "polygon"}},
          &gi.valShading.farShape);
    s.add({"val_shading", "near_reach", 0, 1e6, "half lengths",
           "lights nearer to a screen tile than this are met by each of its pixels; 0: none"},
          &gi.valShading.nearReach);
    s.add({"val_shading", "interleave", 1, 4, "pixels",
           "blocks of n x n pixels share the far lights, each pixel meets a part of them"},
          &gi.valShading.interleave);
    s.add({"ism_atlas", "enabled", 0, 0, "", "visibility of indirect light"}, &gi.ismAtlas.enabled);
    s.add({"ism_atlas", "tile_size", 16, 128, "texels",
           "side of a light's depth map, rounded down to a multiple of 16"},
          &gi.ismAtlas.tileSize);
    s.add({"ism_atlas", "points_per_map", 64, 131072, "points", "splatted into each depth map"},
          &gi.ismAtlas.pointsPerMap);
    s.add({"ism_atlas", "near_more", 0, 0, "", "more points from surfaces near the light, fewer far off"},
          &gi.ismAtlas.nearMore);
    s.add(
        {"ism_atlas", "splat_scale", 0.1, 10, "", "of the points' disks; at 1 they have the surfaces' area"},
        &gi.ismAtlas.splatScale);
    s.add({"ism_atlas", "mapping", 0, 0, "", "of the hemisphere to a square", {"octahedral", "paraboloid"}},
          &gi.ismAtlas.mapping);
    s.add({"ism_atlas", "planes", 0, 0, "", "texels keep planes; off: distances with a bias of a disk"},
          &gi.ismAtlas.planes);
    s.add({"ism_atlas", "keep_maps", 0, 0, "", "do not splat again for lights that stand still"},
          &gi.ismAtlas.keepMaps);
    s.add({"ism_atlas", "pull_push", 0, 0, "", "close the holes between points"}, &gi.ismAtlas.pullPush);
    s.add({"refresh", "light_frames", 1, 64, "frames",
           "while only small things move, from one time that lights are clustered to the next; 1: always"},
          &gi.refresh.lightFrames);
    s.add({"refresh", "pixel_frames", 1, 16, "frames",
           "in which all pixels are gathered meanwhile that are as they were"},
          &gi.refresh.pixelFrames);
    s.add({"refresh", "small", 0, 1, "", "of what the camera or a light sees, what counts as small"},
          &gi.refresh.small);
    s.add({"ssvp", "clusters", 1, 64, "clusters", "of point lights, each with a paraboloid map"},
          &gi.ssvp.clusters);
    s.add({"ssvp", "second_count", 0, 4096, "lights", "of the second bounce"}, &gi.ssvp.secondCount);
    s.add({"ssvp", "rounds", 1, 20, "rounds", "of k-means a frame"}, &gi.ssvp.rounds);
    s.add({"ssvp", "map_size", 16, 512, "texels", "side of a paraboloid's square, a multiple of 16"},
          &gi.ssvp.mapSize);
    s.add({"ssvp", "disk", 0, 0, "", "sample the paraboloids' disks; off: the squares round them"},
          &gi.ssvp.disk);
    s.add({"later_bounces", "enabled", 0, 0, "", "light goes on after its first bounce"},
          &gi.laterBounces.enabled);
    s.add({"later_bounces", "feedback", 0, 0, "", "and after its second; off: no more than two"},
          &gi.laterBounces.feedback);
    s.add({"later_bounces", "share", 0.05, 0.8, "", "of all clusters"}, &gi.laterBounces.share);
    s.add({"later_bounces", "spacing", 1, 4, "pixels",
           "of those bounced light is gathered at, to those later bounces are"},
          &gi.laterBounces.spacing);
    s.add({"later_bounces", "settle_frames", 1, 1000000, "frames",
           "light goes on bouncing after anything last changed"},
          &gi.laterBounces.settleFrames);
    s.add({"val_shading", "taps", 1, 64, "taps", "of near lights' soft shadows; 1: hard ones"},
          &gi.valShading.taps);
    s.add({"val_shading", "far_taps", 1, 64, "taps", "of far lights' soft shadows; 1: hard ones"},
          &gi.valShading.farTaps);
    s.add({"val_shading", "glossy", 0, 0, "",
           "area lights shine on materials by their roughness; off: all are Lambert"},
          &gi.valShading.glossy);
    s.add({"stochastic_rsm", "samples", 1, 4096, "samples", "of each light map, a pixel"},
          &gi.stochasticRsm.samples);
    s.add({"stochastic_rsm", "radius", 0.001, 2, "map widths",
           "of the disk about the pixel's projection; light beyond it is lost"},
          &gi.stochasticRsm.radius);
    s.add({"stochastic_rsm", "interpolate", 0, 0, "",
           "gather a 16th of the pixels, blend where surfaces are alike"},
          &gi.stochasticRsm.interpolate);
    s.add({"stochastic_rsm", "random", 0, 0, "", "other samples in each pixel and frame, for the denoiser"},
          &gi.stochasticRsm.random);
    s.add({"stochastic_rsm", "whole", 0, 0, "",
           "every other sample from all of the map, so that no light is lost"},
          &gi.stochasticRsm.whole);
    s.add({"stochastic_rsm", "visible", 0, 0, "",
           "samples as far as their cluster's imperfect shadow map lets them be seen"},
          &gi.stochasticRsm.visible);
    s.add({"stochastic_rsm", "settle_frames", 0, 1000000, "frames",
           "with new samples after anything last changed"},
          &gi.stochasticRsm.settleFrames);
    s.add({"denoiser", "enabled", 0, 0, "", "steady and smooth indirect light over frames and screen"},
          &gi.denoiser.enabled);
    s.add({"denoiser", "least_share", 0.001, 1, "", "of a new frame in the mean"}, &gi.denoiser.leastShare);
    s.add({"denoiser", "most_length", 1, 2048, "frames", "a history stands for"}, &gi.denoiser.mostLength);
    s.add({"denoiser", "rounds", 0, 5, "rounds", "of the filter, each twice as wide"}, &gi.denoiser.rounds);
    s.add({"denoiser", "separable", 0, 0, "", "filter along two lines instead of over a square"},
          &gi.denoiser.separable);
    s.add({"denoiser", "recurrent", 0, 0, "", "the filter's first round goes into the history"},
          &gi.denoiser.recurrent);
    s.add({"denoiser", "adaptive", 0, 0, "", "changing light takes over, bright samples are spread"},
          &gi.denoiser.adaptive);
    s.add({"denoiser", "motion", 0, 0, "", "histories follow what moves"}, &gi.denoiser.motion);
    s.add({"denoiser", "light_tolerance", 0, 1000, "deviations",
           "by which the light of taps may differ; 0: any"},
          &gi.denoiser.lightTolerance);
    s.add({"shadow_maps", "resolution", 64, 4096, "texels", "side of a sun's cascade"},
          &gi.shadowMaps.resolution);
    s.add({"shadow_maps", "cascades", 1, 4, "", "cascades of a sun"}, &gi.shadowMaps.cascades);
    s.add({"shadow_maps", "cascade_reach", 0.001, 1, "",
           "part of the way to the scene's end that cascades share out; the last one goes on to it"},
          &gi.shadowMaps.cascadeReach);
    s.add({"shadow_maps", "cascade_split", 0, 1, "", "0 uniform, 1 logarithmic"},
          &gi.shadowMaps.cascadeSplit);
    s.add({"light_clusters", "most", 0, kMostLampClusters, "clusters", "of lamps, each with a shadow map"},
          &gi.lightClusters.most);
    s.add({"light_clusters", "growth", 0, 10, "", "m between clusters' centres for each m to the camera"},
          &gi.lightClusters.growth);
    s.add({"light_clusters", "strong_first", 0, 0, "",
           "lamps that matter keep a shadow map of their own longer"},
          &gi.lightClusters.strongFirst);
    s.add({"light_clusters", "hysteresis", 0, 1, "", "part of the distance that a centre of before needs"},
          &gi.lightClusters.hysteresis);
    s.add({"light_clusters", "share_within", 0, 100, "",
           "part of its range that a lamp may be from the centre whose shadow it shares; 0: no limit"},
          &gi.lightClusters.shareWithin);
    s.add({"lamp_shadows", "face_resolution", 16, 2048, "texels",
           "side of a cube's face, at most; a spot's map has twice"},
          &gi.lampShadows.faceResolution);
    s.add({"lamp_shadows", "atlas_size", 256, 16384, "texels", "side of the atlas"},
          &gi.lampShadows.atlasSize);
    s.add({"lamp_shadows", "soft_taps", 0, 64, "taps",
           "of a disk as large as a cluster, for its shadow; 0: from its centre"},
          &gi.lampShadows.softTaps);
    s.add({"probes", "taps", 1, 32, "", "of area lights' soft shadows at probes"}, &gi.probes.taps);
    s.add({"lamp_lighting", "tiles", 0, 0, "", "pixels meet only lamps that reach their tile"},
          &gi.lampLighting.tiles);
    s.add({"lamp_lighting", "shadow_reach", 0, 100, "",
           "times a lamp's distance from its cluster's centre, from where on it has all of its shadow"},
          &gi.lampLighting.shadowReach);
    s.add({"lamp_lighting", "quads", 0, 0, "", "shadows at one pixel of each 2 x 2"}, &gi.lampLighting.quads);
    s.add({"composite", "exposure", -20, 20, "stops", "of the display image"}, &gi.composite.exposure);
    s.add({"composite", "tonemap", 0, 0, "", "curve of the display image", {"none", "reinhard", "aces"}},
          &gi.composite.tonemap);
}

}  // namespace ag::gi
