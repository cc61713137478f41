#include "tools/bench/techniques.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/renderer/frame_budget.h"

namespace ag::bench {
namespace {

constexpr std::initializer_list<int> kCounts = {64, 128, 256, 512};

std::vector<Variant> clusterBudgets(std::initializer_list<int> counts) {
    std::vector<Variant> variants;
    for (const int count : counts)
        variants.push_back({fmt::format("{}", count), {fmt::format("val_clustering.count={}", count)}});
    return variants;
}

std::vector<Variant> mapSizes(std::initializer_list<int> sizes) {
    std::vector<Variant> variants;
    for (const int size : sizes)
        variants.push_back({fmt::format("{}²", size), {fmt::format("rsm.resolution={}", size)}});
    return variants;
}

std::vector<Variant> ours() {
    std::vector<Variant> variants = clusterBudgets(kCounts);
    variants.push_back({"128, RSM 256²", {"rsm.resolution=256"}});
    variants.push_back({"256, RSM 1024²", {"val_clustering.count=256", "rsm.resolution=1024"}});
    variants.push_back({"128 not adaptive", {"val_clustering.adaptive=off"}});
    return variants;
}

std::vector<Variant> twoBounces() {
    std::vector<Variant> variants;
    for (const int count : {128, 256})
        variants.push_back({fmt::format("{}", count),
                            {fmt::format("val_clustering.count={}", count), "later_bounces.feedback=off"}});
    variants.push_back(
        {"256, maps 512²", {"val_clustering.count=256", "rsm.resolution=512", "later_bounces.feedback=off"}});
    return variants;
}

std::vector<Variant> paraboloids() {
    std::vector<Variant> variants;
    for (const int count : {4, 8, 16, 32})
        variants.push_back({fmt::format("{} clusters", count), {fmt::format("ssvp.clusters={}", count)}});
    variants.push_back({"32 clusters, 1024 lights", {"ssvp.clusters=32", "ssvp.second_count=1024"}});
    variants.push_back(
        {"the same, squares", {"ssvp.clusters=32", "ssvp.second_count=1024", "ssvp.disk=off"}});
    return variants;
}

// What a budget chooses among.
std::vector<Variant> qualityLadder() {
    std::vector<Variant> variants;
    for (const render::QualityStep& s : render::qualitySteps().subspan(render::firstFullSizeStep()))
        variants.push_back(
            {s.name,
             {fmt::format("rsm.resolution={}", s.mapResolution),
              fmt::format("val_clustering.count={}", s.valCount),
              fmt::format("ism_atlas.tile_size={}", s.ismTile),
              fmt::format("ism_atlas.points_per_map={}", s.pointsPerMap),
              fmt::format("gi.spacing={}", s.spacing), fmt::format("val_shading.near_reach={}", s.nearReach),
              fmt::format("val_shading.taps={}", s.taps)}});
    return variants;
}

std::vector<Variant> punctualBudgets() {
    std::vector<Variant> variants;
    for (const int count : {10, 26})
        variants.push_back(
            {fmt::format("{} clusters", count), {fmt::format("light_clusters.most={}", count)}});
    return variants;
}

std::vector<Technique> makeTechniques() {
    return {
        {.name = "none", .description = "no indirect light", .variants = {{"", {}}}},
        {.name = "rsm-brute",
         .description = "every RSM texel a point emitter, unshadowed",
         .variants = mapSizes({32, 64, 128})},
        {.name = "rsm-brute-visible",
         .description = "the same with ray-traced visibility, on the CPU",
         .runner = Runner::kEmitters,
         .variants = {{"32²", {}}}},
        {.name = "rsm-400",
         .description = "400 fixed samples of the RSM (Dachsbacher & Stamminger 2005)",
         .variants = {{"all pixels", {}},
                      {"interpolated", {"stochastic_rsm.interpolate=on"}},
                      {"randomised", {"stochastic_rsm.random=on"}}}},
        {.name = "irsm",
         .description = "few samples of the RSM, denoised as published",
         .variants = {{"4 samples", {"stochastic_rsm.samples=4"}},
                      {"8 samples", {}},
                      {"8 samples, square filter", {"denoiser.separable=off"}}}},
        {.name = "stochastic",
         .description = "few samples of the RSM and our denoiser",
         .variants = {{"4 samples", {"stochastic_rsm.samples=4"}},
                      {"8 samples", {}},
                      {"8 samples, unshadowed", {"stochastic_rsm.visible=off"}},
                      {"8 samples, all pixels", {"gi.spacing=1", "denoiser.rounds=3"}}}},
        {.name = "ism",
         .description = "virtual point lights with imperfect shadow maps (Ritschel et al. 2008)",
         .variants = clusterBudgets({512, 1024})},
        {.name = "acrsm",
         .description = "adaptively clustered RSM with soft imperfect shadows, as published",
         .variants = clusterBudgets({128, 512})},
        {.name = "rsmc",
         .description = "RSM clustering with published disks (Prutkin et al. 2012)",
         .variants = clusterBudgets(kCounts)},
        {.name = "afterglow", .description = "ours", .variants = ours()},
        {.name = "low", .description = "ours, least work", .variants = {{"", {}}}},
        {.name = "high", .description = "ours, for more accuracy", .variants = {{"", {}}}},
        {.name = "ultra", .description = "ours, accuracy first", .variants = {{"", {}}}},
        {.name = "ssvp",
         .description = "point lights and what their clusters see, two bounces (Aranha et al.)",
         .term = "two_bounces",
         .variants = paraboloids()},
        {.name = "afterglow-bounces",
         .description = "ours, two bounces",
         .term = "two_bounces",
         .variants = twoBounces()},
        {.name = "steps",
         .preset = "afterglow",
         .description = "ours, the steps of quality that --budget-ms chooses among",
         .onlyByName = true,
         .variants = qualityLadder()},
        {.name = "lights-reference",
         .description = "direct light of punctual lights, a shadow map each",
         .term = "direct",
         .variants = {{"", {}}}},
        {.name = "lightcluster",
         .description = "lights in clusters that share a shadow map, as published (Wiesenhütter et al.)",
         .term = "direct",
         .variants = punctualBudgets()},
        {.name = "afterglow-lights",
         .description = "lights in clusters and tiles, ours",
         .term = "direct",
         .variants = punctualBudgets()},
    };
}

}  // namespace

Technique budgetTechnique(const std::vector<double>& budgetsMs) {
    Technique budget{.name = "budget", .preset = "afterglow", .description = "ours within a time"};
    for (const double ms : budgetsMs)
        budget.variants.push_back({fmt::format("{:g} ms", ms), {}, ms});
    return budget;
}

std::span<const Technique> techniques() {
    static const std::vector<Technique> all = makeTechniques();
    return all;
}

namespace {

constexpr uint32_t kAllBounces = 16;
struct Term {
    std::string_view name, layer;
    uint32_t bounces;
};
constexpr std::array<Term, 7> kTerms = {{{"all", "radiance", kAllBounces},
                                         {"direct", "direct", 0},
                                         {"emissive", "emissive", 0},
                                         {"sky", "sky", 0},
                                         {"bounces", "indirect", kAllBounces},
                                         {"bounce1", "bounce1", 1},
                                         {"two_bounces", "indirect", 2}}};
constexpr auto kTermNames = [] {
    std::array<std::string_view, kTerms.size()> names;
    for (size_t i = 0; i < names.size(); ++i)
        names[i] = kTerms[i].name;
    return names;
}();

const Term& termOf(std::string_view name) {
    return *std::ranges::find(kTerms, name, &Term::name);
}

}  // namespace

std::span<const std::string_view> terms() {
    return kTermNames;
}

bool isTerm(std::string_view term) {
    return std::ranges::find(kTermNames, term) != kTermNames.end();
}

std::string_view layerOfTerm(std::string_view term) {
    return termOf(term).layer;
}

uint32_t bouncesOfTerm(std::string_view term) {
    return termOf(term).bounces;
}

const Technique* findTechnique(std::string_view name) {
    const auto found = std::ranges::find(techniques(), name, &Technique::name);
    return found == techniques().end() ? nullptr : &*found;
}

}  // namespace ag::bench
