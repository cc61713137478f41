#include "gi/settings.h"

#include <algorithm>
#include <array>

namespace ag::gi {
namespace {

// Lights, points a shadow map is made of, texels of RSMs, and how many pixels are gathered.
void setLow(BounceLightSettings& s) {
    s.rsm.resolution = 256;
    s.valClustering.count = 64;
    s.ismAtlas = {.tileSize = 32, .pointsPerMap = 1024};
    s.spacing = 3;
    s.texelRays.enabled = false;
}

void setMedium(BounceLightSettings&) {}

void setHigh(BounceLightSettings& s) {
    s.rsm.resolution = 512;
    s.valClustering.count = 256;
    s.ismAtlas = {.tileSize = 64, .pointsPerMap = 4096};
}

void setUltra(BounceLightSettings& s) {
    s.rsm.resolution = 1024;
    s.valClustering.count = 512;
    s.ismAtlas = {.tileSize = 128, .pointsPerMap = 8192};
    s.valShading.nearReach = 6;
    s.valShading.taps = 16;
}

struct QualityRow {
    std::string_view name;
    void (*apply)(BounceLightSettings&);
};
constexpr std::array kQualities = {QualityRow{"low", setLow}, QualityRow{"medium", setMedium},
                                   QualityRow{"high", setHigh}, QualityRow{"ultra", setUltra}};

}  // namespace

bool applyQuality(std::string_view name, BounceLightSettings& s) {
    const auto found = std::ranges::find(kQualities, name, &QualityRow::name);
    if (found == kQualities.end()) return false;
    found->apply(s);
    return true;
}

void registerSettings(Settings& settings, BounceLightSettings& s) {
    settings.add(
        {"gi", "spacing", 1, 4, "pixels", "from one that indirect light is gathered at to the next", {}},
        &s.spacing);
    registerFields(settings, "rsm", s.rsm);
    registerFields(settings, "importance", s.importance);
    registerFields(settings, "val_clustering", s.valClustering);
    registerFields(settings, "ism_atlas", s.ismAtlas);
    registerFields(settings, "later_bounces", s.laterBounces);
    registerFields(settings, "val_shading", s.valShading);
    registerFields(settings, "texel_rays", s.texelRays);
    registerFields(settings, "gloss_rays", s.glossRays);
    registerFields(settings, "stochastic_rsm", s.stochasticRsm);
    registerFields(settings, "denoiser", s.denoiser);
    registerFields(settings, "probes", s.probes);
    registerFields(settings, "sky", s.sky);
    registerFields(settings, "refresh", s.refresh);
}

}  // namespace ag::gi
