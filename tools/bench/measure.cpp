#include "tools/bench/measure.h"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <chrono>

#include "engine/core/flip.h"
#include "engine/core/hash.h"
#include "engine/core/settings.h"
#include "engine/renderer/frame_budget.h"
#include "engine/scene/static_scene.h"
#include "tools/bench/path_tracing.h"
#include "tools/bench/walking.h"
#include "tools/reference/vpl_tracer.h"

namespace ag::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr uint32_t kWarmFrames = 64;                         // for clusters and histories to settle
constexpr uint32_t kShadedFrames = 24;                       // of those with clusters, for histories
constexpr double kSlowestMovingMs = 400;                     // what takes longer is no light to move in
constexpr uint32_t kBudgetFrames = 120, kBudgetJudged = 30;  // within which a budget is met; the last ones
constexpr uint32_t kEmitterMap = 32;                         // texels along an RSM's side
constexpr uint32_t kTrendSamples = 1024;                     // a pixel of each key of the flicker's trend

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

double threadCpuMs() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) * 1e3 + double(t.tv_nsec) * 1e-6;
}

double quantile(std::vector<double> values, double q) {
    if (values.empty()) return 0;
    const auto at = values.begin() + std::ptrdiff_t(q * double(values.size() - 1) + 0.5);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

// Just the layer, so that only the passes it needs run.
struct Frame {
    render::Renderer& renderer;
    glm::uvec2 size;
    render::Layer layer;
    ImageHandle shown{};
    uint32_t emitters = 0;
    bool clustered = false;

    void render(const RenderScene& scene, const render::RenderSettings& settings,
                const FrameGraphOptions& options, bool onlyClusters = false) {
        renderer.render(
            scene, size, settings, options,
            [&](GraphScope scope, const render::SceneView& view, const render::RenderFrame& frame) {
                if (onlyClusters) return scope.output(frame.bounce.clusters.clusters);
                shown = render::addLayer(scope, view, frame, layer);
                if (shown) scope.output(shown);
                emitters = settings.technique == render::Technique::kAreaLights ? frame.bounce.vals.count : 0;
                clustered = bool(frame.bounce.clusters.clusters);
            });
    }
    void settle(const RenderScene& scene, const render::RenderSettings& settings) {
        render(scene, settings, {});
        for (uint32_t i = 1; i < kWarmFrames; ++i)
            render(scene, settings, {}, clustered && i < kWarmFrames - kShadedFrames);
    }
    // Until rays to texels rest; false: none are cast.
    bool refine(const RenderScene& scene, const render::RenderSettings& settings) {
        if (!render::castsTexelRays(settings)) return false;
        for (uint32_t i = 0; i < gi::framesToRest(settings.bounce); ++i)
            render(scene, settings, {});
        return true;
    }
    Image image() const {
        return shown ? render::readImage(renderer, shown) : Image(int(size.x), int(size.y));
    }
};

}  // namespace

SceneBench::SceneBench(gpu::Device& device, const RenderScene& scene, std::string name,
                       ReferenceSource references, const MeasureOptions& options,
                       FunctionRef<void(double)> progress)
    : renderer_(device),
      scene_(scene),
      flickerScene_(scene),
      name_(std::move(name)),
      cache_(references.cache),
      runner_(references.runner),
      options_(options),
      progress_(progress),
      rays_(scene) {
    setCamera(flickerScene_, poseOf(scene), options.flickerSize);
}

reference::ReferenceSettings SceneBench::referenceSettings(std::string_view term) const {
    return {.paths = {.bounces = bouncesOfTerm(term), .glossy = term == "all"},
            .samplesPerPixel = options_.referenceSamples,
            .maxError = options_.referenceError,
            .layer = std::string(layerOfTerm(term))};
}

Result<const TwoReferences*> SceneBench::reference(std::string_view term) {
    const auto known = references_.find(term);
    if (known != references_.end()) return &known->second;
    auto made = cache_.getTwo(scene_, options_.size, referenceSettings(term), runner_, progress_);
    if (!made) return made.error();
    return &references_.emplace(term, std::move(*made)).first->second;
}

Result<const ReferenceTrend*> SceneBench::trend(std::string_view term) {
    const auto known = trends_.find(term);
    if (known != trends_.end()) return &known->second;
    reference::ReferenceSettings settings = referenceSettings(term);
    settings.samplesPerPixel = kTrendSamples;
    settings.maxError = 0;
    auto made =
        ReferenceTrend::make(cache_, flickerScene_, options_.flickerSize, settings, runner_, progress_);
    if (!made) return made.error();
    return &trends_.emplace(term, std::move(*made)).first->second;
}

void SceneBench::timeFrames(const render::RenderSettings& settings, render::Layer layer, Row& row) {
    Frame frame{renderer_, options_.size, layer};
    FrameGraphOptions everything;
    everything.skip = false;
    everything.timing = TimingMode::kBracketed;
    std::vector<double> totals, host;
    std::map<std::string, std::vector<double>> passes;
    const auto start = Clock::now();
    // Timestamps arrive a few frames late: the first ones are of frames that also compiled.
    constexpr uint32_t kLate = 4;
    for (uint32_t i = 0; i < options_.frames + kLate; ++i) {
        if (i >= 5 + kLate && secondsSince(start) > options_.secondsPerTiming) break;
        const double before = threadCpuMs();
        frame.render(scene_, settings, everything);
        if (i < kLate) continue;
        host.push_back(threadCpuMs() - before);
        double total = 0;
        for (const PassReport& pass : renderer_.graph().report()) {
            if (pass.outcome != PassOutcome::kRan || pass.name.starts_with("debug_view.")) continue;
            passes[std::string(pass.name)].push_back(pass.gpuMs);
            total += pass.gpuMs;
        }
        totals.push_back(total);
    }
    renderer_.waitIdle();
    row.frames = uint32_t(totals.size());
    row.gpuMsMedian = quantile(totals, 0.5);
    row.gpuMsP99 = quantile(totals, 0.99);
    row.cpuMsMedian = quantile(host, 0.5);
    for (auto& [name, times] : passes)
        row.passes[name] = quantile(times, 0.5);
    row.gbufferMs = row.passes["gbuffer.fill"];
    const bool nothing = settings.technique == render::Technique::kNone && layer != render::Layer::kDirect;
    if (nothing) row.gbufferMs = row.gpuMsMedian = 0;
}

// As a program with --budget-ms does it, frame after frame of a scene in which all passes run.
void SceneBench::settleBudget(double budgetMs, render::RenderSettings& settings, render::Layer layer,
                              Row& row) {
    render::BudgetController budget(budgetMs, render::firstFullSizeStep());
    render::FrameCost cost;
    const auto apply = [&] { render::applyQualityStep(render::qualitySteps()[budget.step()], settings); };
    apply();
    Frame frame{renderer_, options_.size, layer};
    std::vector<double> last;
    uint32_t changes = 0;
    for (uint32_t i = 0; i < kBudgetFrames; ++i) {
        frame.render(scene_, settings, {.skip = false});
        const double ms = cost.add(renderer_.graph().report());
        if (i >= kBudgetFrames - kBudgetJudged) last.push_back(ms);
        if (!budget.frame(ms)) continue;
        ++changes;
        apply();
    }
    row.settings["budget_ms"] = fmt::format("{:g}", budgetMs);
    row.settings["budget_step"] = render::qualitySteps()[budget.step()].name;
    row.settings["budget_changes"] = std::to_string(changes);
    row.settings["budget_median_ms"] = fmt::format("{:.2f}", quantile(last, 0.5));
}

Status SceneBench::measureFlicker(const render::RenderSettings& settings, render::Layer layer, Row& row) {
    const auto truth = trend(row.term);
    if (!truth) return truth.error();
    Frame frame{renderer_, options_.flickerSize, layer};
    RenderScene scene = flickerScene_;
    frame.settle(scene, settings);
    std::vector<Image> still, moving;
    for (uint32_t i = 0; i < kStillFrames; ++i) {
        frame.render(scene, settings, {});
        still.push_back(frame.image());
    }
    for (uint32_t i = 0; i < kFlickerFrames; ++i) {
        scene.lights = movedLights(scene_, double(i) / (kFlickerFrames - 1));
        ++scene.lightsVersion;
        frame.render(scene, settings, {});
        moving.push_back(frame.image());
        for (const PassReport& pass : renderer_.graph().report())
            row.skipped[std::string(pass.name)] +=
                pass.outcome == PassOutcome::kSkipped ? 1.0 / kFlickerFrames : 0;
    }
    row.flickerStill = flickerOf(still, nullptr);
    row.flickerMoving = flickerOf(moving, *truth);
    return Ok{};
}

void SceneBench::measureWalking(const render::RenderSettings& settings, render::Layer layer, Row& row) {
    Frame frame{renderer_, options_.flickerSize, layer};
    RenderScene scene = flickerScene_;
    std::vector<Image> standing, walking;
    constexpr uint32_t kStep = kWalkFrames / kWalkStops;
    for (uint32_t at = kStep - 1; at < kWalkFrames; at += kStep) {
        placeOnWalk(scene, flickerScene_, options_.flickerSize, at);
        frame.settle(scene, settings);
        standing.push_back(frame.image());
    }
    placeOnWalk(scene, flickerScene_, options_.flickerSize, 0);
    frame.settle(scene, settings);
    for (uint32_t at = 0; at < kWalkFrames; ++at) {
        placeOnWalk(scene, flickerScene_, options_.flickerSize, at);
        frame.render(scene, settings, {});
        if (at % kStep == kStep - 1) walking.push_back(frame.image());
    }
    const Walking walk = compareWalk(walking, standing);
    row.flickerWalking = walk.flicker;
    row.ghosting = walk.ghosting;
}

Result<std::vector<Image>> SceneBench::measureGpu(const Technique& technique, const Variant& variant,
                                                  Row& row) {
    render::RenderSettings settings;
    Settings registry;
    render::registerSettings(registry, settings);
    const std::string_view preset = technique.preset.empty() ? technique.name : technique.preset;
    if (!render::applyPreset(preset, settings)) return Error{fmt::format("there is no preset '{}'", preset)};
    const render::RenderSettings plain = settings;
    for (const std::string& assignment : variant.settings) {
        if (const Status set = registry.set(assignment); !set) return set.error();
        const size_t equals = assignment.find('=');
        row.settings[assignment.substr(0, equals)] = assignment.substr(equals + 1);
    }
    const bool isPreset = settings == plain && variant.budgetMs == 0;
    const auto layer = render::layerFromName(layerOfTerm(row.term));
    if (!layer) return Error{fmt::format("there is no layer '{}'", row.term)};
    // Ours has them by a setting so far.
    const bool goesOn = row.term == "all" || row.term == "bounces";
    if (goesOn && settings.technique == render::Technique::kAreaLights)
        settings.bounce.laterBounces.enabled = true;
    settings = render::settingsOf(*layer, settings);
    renderer_.load(*scene_.geometry);
    if (variant.budgetMs > 0) settleBudget(variant.budgetMs, settings, *layer, row);
    Frame frame{renderer_, options_.size, *layer};
    frame.settle(scene_, settings);
    const bool rests = frame.refine(scene_, settings);
    std::vector<Image> images = {frame.image()};
    row.vals = frame.emitters;
    row.gpuBytes = renderer_.deviceBytes();
    timeFrames(settings, *layer, row);
    if (options_.flicker && row.gpuMsMedian <= kSlowestMovingMs) {
        measureWalking(settings, *layer, row);
        if (const Status done = measureFlicker(settings, *layer, row); !done) return done.error();
    }
    // Rays at rest take a minute a clustering and depend little on it: several for the preset alone.
    const uint32_t clusterings = frame.clustered && (isPreset || !rests) ? options_.clusterings : 1;
    for (uint32_t seed = 1; seed < clusterings; ++seed) {
        settings.bounce.valClustering.seed = seed;
        renderer_.load(*scene_.geometry);
        frame.settle(scene_, settings);
        frame.refine(scene_, settings);
        images.push_back(frame.image());
    }
    return images;
}

Image SceneBench::measureEmitters(Row& row) {
    const auto start = Clock::now();
    uint64_t count = 0;
    reference::FirstHits hits(options_.size);
    reference::traceFirstHits(rays_, {}, {}, runner_, hits, count);
    const auto emitters = reference::traceEmitters(rays_, kEmitterMap, 1, count);
    reference::LightSums sums(options_.size, 1);
    reference::addEmitters(rays_, hits, emitters, {.count = uint32_t(emitters.size())}, runner_, sums);
    row.gpuMsMedian = row.gpuMsP99 = secondsSince(start) * 1e3;
    row.frames = 1;
    row.settings["emitter_map"] = std::to_string(kEmitterMap);
    Image image = sums.bounces[1];
    for (glm::vec3& p : image.pixels)
        p /= float(std::max(emitters.size(), size_t(1)));
    return image;
}

uint64_t SceneBench::hashPathTracing(std::string_view term) const {
    return hashValue(options_.size, hashSettings(referenceSettings(term), sceneHash(scene_)));
}

Result<std::vector<Row>> SceneBench::measurePathTracing(std::string_view term) {
    const auto truth = reference(term);
    if (!truth) return truth.error();
    const std::string layer(layerOfTerm(term));
    auto rows = tracePathCurve(rays_, withBlended(rays_, referenceSettings(term)).paths, layer,
                               (*truth)->both(), runner_);
    for (Row& row : rows) {
        row.scene = name_;
        row.term = term;
        row.noiseFloor = (*truth)->noise;
    }
    return rows;
}

Result<Row> SceneBench::measure(const Technique& technique, const Variant& variant) {
    const auto truth = reference(technique.term);
    if (!truth) return truth.error();
    Row row;
    row.scene = name_;
    row.technique = technique.name;
    row.variant = variant.label;
    row.size = options_.size;
    row.term = technique.term;
    row.noiseFloor = (*truth)->noise;
    std::vector<Image> images;
    if (technique.runner == Runner::kEmitters) {
        images.push_back(measureEmitters(row));
    } else {
        auto measured = measureGpu(technique, variant, row);
        if (!measured) return measured.error();
        images = std::move(*measured);
    }
    if (const Status done = compare(images, **truth, row); !done)
        return Error{fmt::format("{} on {}: {}", technique.name, name_, done.error().message)};
    return row;
}

Status SceneBench::compare(const std::vector<Image>& images, const TwoReferences& truth, Row& row) {
    std::vector<ImageDifference> differences;
    const Image middle = meanOf(truth.both());
    for (const Image& image : images) {
        const auto difference = compareImages(truth.both(), image);
        if (!difference) return difference.error();
        differences.push_back(*difference);
        row.flip += meanFlip(middle, image) / double(images.size());
    }
    row.clusterings = uint32_t(images.size());
    row.error = meanOf(differences);
    const auto [least, most] = std::ranges::minmax(differences, {}, &ImageDifference::relativeRmse);
    row.relRmseSpread = most.relativeRmse - least.relativeRmse;
    return Ok{};
}

}  // namespace ag::bench
