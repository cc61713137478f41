#include "engine/capture/advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/capture/levers.h"
#include "engine/core/settings.h"
#include "engine/renderer/frame_budget.h"

namespace ag::capture {
namespace {

constexpr double kWorthSaying = 0.01;  // of the frame
constexpr uint32_t kMapOfALight =
    512;  // texels: what rsm.resolution=0 stands for unless a light says otherwise
constexpr std::array<std::string_view, 13> kIndirect = {
    "rsm",         "importance", "val_clustering", "val_fit",    "ism_atlas",  "surface_points",
    "val_shading", "val_gloss",  "texel_rays",     "gloss_rays", "upsampling", "later_bounces",
    "denoiser"};

double msOf(const Span& pass) {
    return double(pass.endNs - pass.beginNs) * 1e-6;
}

bool isOf(std::string_view pass, std::string_view technique) {
    return pass.starts_with(technique) && (pass.size() == technique.size() || pass[technique.size()] == '.');
}

double msOf(const Frame& frame, std::string_view technique) {
    double ms = 0;
    for (const Span& pass : frame.gpu)
        if (isOf(pass.name, technique)) ms += msOf(pass);
    return ms;
}

double msOf(const Frame& frame) {
    double ms = 0;
    for (const Span& pass : frame.gpu)
        ms += msOf(pass);
    return ms;
}

const Setting* find(const Settings& settings, std::string_view name) {
    for (const Setting& s : settings.all())
        if (fmt::format("{}.{}", s.info.group, s.info.name) == name) return &s;
    return nullptr;
}

// The lower value; the same where it cannot be lowered that far.
double lowered(const Lever& lever, double now) {
    const double next = lever.by == 0 ? 0 : lever.adds ? now + lever.by : now * lever.by;
    const bool beyond = lever.adds ? next > lever.limit : next < lever.limit;
    return beyond ? now : next;
}

double valueOf(const Lever& lever, const Setting& setting) {
    const double value = settingValue(setting);
    return lever.setting == "rsm.resolution" && value == 0 ? kMapOfALight : value;
}

// Without savings where the frame has none of its passes.
Advice adviceOf(const Lever& lever, const Setting& setting, const Frame& frame) {
    const bool whole = !std::holds_alternative<float*>(setting.value);
    const double now = valueOf(lever, setting), asked = lowered(lever, now);
    const double next = whole ? std::floor(asked) : asked;
    Advice advice{.assignment = fmt::format("{}={}", lever.setting, settingText(setting, next)),
                  .from = settingText(setting, now),
                  .errorTimes = lever.errorTimes,
                  .term = lever.term};
    if (next == now) return advice;
    for (const Remainder& left : lever.left) {
        const double saved = msOf(frame, left.technique) * (1 - left.share);
        if (left.technique.empty() || saved <= 0) continue;
        advice.savings.push_back({left.technique, saved});
        advice.savedMs += saved;
    }
    std::ranges::stable_sort(advice.savings, std::ranges::greater{}, &Saving::ms);
    return advice;
}

// Whether a step asks for no more than the settings do.
bool isWithin(const render::QualityStep& s, const render::RenderSettings& gi) {
    const gi::BounceLightSettings& b = gi.bounce;
    const auto map = [](uint32_t texels) { return texels ? texels : kMapOfALight; };
    return map(s.mapResolution) <= map(b.rsm.resolution) && s.valCount <= b.valClustering.count &&
           s.ismTile <= b.ismAtlas.tileSize && s.pointsPerMap <= b.ismAtlas.pointsPerMap &&
           s.spacing >= b.spacing && s.nearReach <= b.valShading.nearReach && s.taps <= b.valShading.taps;
}

std::string assignmentsOf(const render::QualityStep& s) {
    return fmt::format(
        "rsm.resolution={} val_clustering.count={} ism_atlas.tile_size={} ism_atlas.points_per_map={} "
        "gi.spacing={} val_shading.near_reach={:g} val_shading.taps={}",
        s.mapResolution, s.valCount, s.ismTile, s.pointsPerMap, s.spacing, s.nearReach, s.taps);
}

// The dearest one of known error that the settings reach.
const render::QualityStep* stepAt(const render::RenderSettings& gi) {
    const render::QualityStep* at = nullptr;
    for (const render::QualityStep& s : render::qualitySteps())
        if (s.scale == 1 && s.relativeError > 0 && isWithin(s, gi)) at = &s;
    return at;
}

}  // namespace

std::vector<Advice> adviceFor(const Frame& frame, const render::RenderSettings& gi) {
    render::RenderSettings copy = gi;
    Settings settings;
    render::registerSettings(settings, copy);
    const double all = msOf(frame);
    std::vector<Advice> advices;
    for (const Lever& lever : levers()) {
        const Setting* setting = find(settings, lever.setting);
        if (!setting) continue;
        Advice advice = adviceOf(lever, *setting, frame);
        if (advice.savedMs > kWorthSaying * all) advices.push_back(std::move(advice));
    }
    std::ranges::stable_sort(advices, std::ranges::greater{}, &Advice::savedMs);
    return advices;
}

std::vector<StepAdvice> fasterSteps(const Frame& frame, const render::RenderSettings& gi) {
    if (gi.technique != render::Technique::kAreaLights) return {};
    const render::QualityStep* at = stepAt(gi);
    double ms = 0;
    for (const std::string_view technique : kIndirect)
        ms += msOf(frame, technique);
    std::vector<StepAdvice> steps;
    for (const render::QualityStep& s : render::qualitySteps()) {
        if (!at || &s >= at) break;
        if (s.scale != 1 || s.relativeError == 0) continue;
        const double saved = ms * (1 - s.relativeCost / at->relativeCost);
        if (saved <= kWorthSaying * msOf(frame)) continue;
        steps.push_back({s.name, assignmentsOf(s), saved, double(s.relativeError / at->relativeError)});
    }
    std::ranges::reverse(steps);
    if (steps.size() > 2) steps.resize(2);
    return steps;
}

}  // namespace ag::capture
