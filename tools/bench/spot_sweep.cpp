#include "tools/bench/spot_sweep.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/core/image_difference.h"
#include "engine/gpu/transfer.h"
#include "engine/renderer/renderer.h"
#include "engine/scene/static_scene.h"
#include "tools/bench/svg.h"
#include "tools/scenegen/builder.h"

namespace ag::bench {
namespace {

constexpr glm::uvec2 kSize{96, 54};
constexpr uint32_t kFramesBefore = 32;
constexpr uint32_t kMap = 128;  // texels along the RSM's side

SceneAsset emptyRoom() {
    scenegen::SceneBuilder b("spot sweep");
    const uint32_t white = b.material("white", glm::vec3(0.75f)), red = b.material("red", {0.6f, 0.1f, 0.1f}),
                   green = b.material("green", {0.15f, 0.5f, 0.15f});
    b.room("room", {-1, 0, -1}, {1, 2, 1}, {red, green, white, white, white, white});
    b.spot("lamp", {0, 1, 0}, {0, 0, -1}, glm::vec3(10), {25, 35});
    b.camera("camera", {-0.8f, 1.2f, 0.9f}, {0.4f, 0.9f, -0.6f}, 70);
    return b.finish();
}

// From the back wall to the right one.
glm::vec3 directionAt(double share) {
    const float angle = glm::radians(90.0f * float(share));
    return {std::sin(angle), 0, -std::cos(angle)};
}

struct Run {
    render::Renderer renderer;
    render::RenderSettings settings;
    render::RenderFrame frame;
    ImageHandle shown{};

    explicit Run(gpu::Device& device) : renderer(device) {}

    void render(const RenderScene& scene, const FrameGraphOptions& options = {}) {
        renderer.render(
            scene, kSize, settings, options,
            [&](GraphScope scope, const render::SceneView& view, const render::RenderFrame& declared) {
                frame = declared;
                shown = render::addLayer(scope, view, declared, render::Layer::kBounce1);
                scope.output(shown);
                if (declared.bounce.clusters.clusters) scope.output(declared.bounce.clusters.clusters);
            });
    }
};

double spreadOf(Run& run) {
    const gpu::Buffer& source = run.renderer.graph().physical(run.frame.bounce.clusters.clusters);
    std::vector<io::Cluster> clusters(source.sizeBytes() / sizeof(io::Cluster));
    run.renderer.waitIdle();
    gpu::downloadBuffer(run.renderer.device(), source, std::as_writable_bytes(std::span(clusters)));
    double count = 0, sum = 0, squares = 0;
    for (const io::Cluster& c : clusters) {
        if (c.texelCount <= 0) continue;
        count += 1, sum += double(c.area), squares += double(c.area) * double(c.area);
    }
    const double mean = sum / std::max(count, 1.0);
    return mean > 0 ? std::sqrt(std::max(squares / count - mean * mean, 0.0)) / mean : 0;
}

render::RenderSettings settingsOf(size_t variant, uint32_t clusters) {
    render::RenderSettings gi;
    gi.bounce.rsm.resolution = kMap;
    gi.bounce.ismAtlas.enabled = false;
    gi.bounce.spacing = 1;
    gi.bounce.valClustering.count = clusters;
    gi.bounce.valClustering.adaptive = variant > 0;
    if (variant < 2) gi.bounce.importance.viewWeight = 0;
    return gi;
}

}  // namespace

std::vector<SweepFrame> sweepSpot(gpu::Device& device, const SweepOptions& options,
                                  FunctionRef<void(double)> progress) {
    const SceneAsset asset = emptyRoom();
    RenderScene scene = staticScene(asset);
    setCamera(scene, cameraOf(asset, 0), kSize);
    std::vector<std::unique_ptr<Run>> runs;  // the variants, then the truth
    for (size_t v = 0; v <= kSweepVariants.size(); ++v) {
        runs.push_back(std::make_unique<Run>(device));
        runs.back()->renderer.load(asset.geometry);
        runs.back()->settings = settingsOf(v, options.clusters);
    }
    Run& truth = *runs.back();
    render::applyPreset("rsm-brute", truth.settings);
    truth.settings.bounce.rsm.resolution = kMap;

    std::vector<SweepFrame> measured;
    for (uint32_t i = 0; i < options.frames + kFramesBefore; ++i) {
        const uint32_t step = i < kFramesBefore ? 0 : i - kFramesBefore;
        const double share = double(step) / std::max(options.frames - 1, 1u);
        scene.lights[0].direction = directionAt(share);
        ++scene.lightsVersion;
        for (size_t v = 0; v < kSweepVariants.size(); ++v)
            runs[v]->render(scene);
        if (i < kFramesBefore || step % options.every != 0) continue;
        truth.render(scene);
        const Image exact = render::readImage(truth.renderer, truth.shown);
        SweepFrame frame{.seconds = share * kSweepSeconds};
        for (size_t v = 0; v < kSweepVariants.size(); ++v) {
            frame.spread[v] = spreadOf(*runs[v]);
            const auto difference =
                compareImages(exact, render::readImage(runs[v]->renderer, runs[v]->shown));
            frame.error[v] = difference ? difference->relativeRmse : 0;
        }
        measured.push_back(frame);
        progress(share);
    }
    return measured;
}

std::string sweepToCsv(const std::vector<SweepFrame>& frames) {
    std::string out = "seconds";
    for (const std::string_view what : {"spread", "error"})
        for (const std::string_view variant : kSweepVariants)
            out += fmt::format(",{} {}", what, variant);
    out += '\n';
    for (const SweepFrame& f : frames)
        out += fmt::format("{:.3f},{:.4f},{:.4f}\n", f.seconds, fmt::join(f.spread, ","),
                           fmt::join(f.error, ","));
    return out;
}

namespace {

constexpr double kWidth = 560, kHeight = 300, kLeft = 60, kTop = 84, kBottom = 60;
constexpr std::array<std::string_view, kSweepVariants.size()> kColors = {"#d1495b", "#2e6f95", "#66a182"};

using Values = std::array<double, kSweepVariants.size()>;

std::string panel(const std::vector<SweepFrame>& frames, Values SweepFrame::*values, double left,
                  std::string_view title) {
    double most = 0;
    for (const SweepFrame& f : frames)
        most = std::max(most, *std::ranges::max_element(f.*values));
    const double step = std::pow(10.0, std::floor(std::log10(std::max(most, 1e-6)))) / 2;
    const double top = std::ceil(std::max(most, 1e-6) / step) * step;
    const auto x = [&](double seconds) {
        return left + kLeft + seconds / kSweepSeconds * (kWidth - kLeft - 16);
    };
    const auto y = [&](double value) { return kTop + (1 - value / top) * kHeight; };
    std::string out = svgText(left + kLeft, kTop - 10, "start", 14, title);
    for (double v = 0; v <= top * 1.001; v += top / 5) {
        out += fmt::format("<line x1='{:.1f}' x2='{:.1f}' y1='{:.1f}' y2='{:.1f}' stroke='#e4e4e4'/>\n", x(0),
                           x(kSweepSeconds), y(v), y(v));
        out += svgText(x(0) - 6, y(v) + 4, "end", 11, fmt::format("{:.3g}", v));
    }
    for (int s = 0; s <= int(kSweepSeconds); s += 2)
        out += svgText(x(s), kTop + kHeight + 16, "middle", 11, fmt::format("{} s", s));
    for (size_t v = 0; v < kSweepVariants.size(); ++v) {
        std::string points;
        for (const SweepFrame& f : frames)
            points += fmt::format("{:.1f},{:.1f} ", x(f.seconds), y((f.*values)[v]));
        out += fmt::format("<polyline points='{}' fill='none' stroke='{}' stroke-width='1.6'/>\n", points,
                           kColors[v]);
    }
    return out;
}

}  // namespace

std::string sweepToSvg(const std::vector<SweepFrame>& frames) {
    std::string out = svgBegin(2 * kWidth, kTop + kHeight + kBottom);
    out += svgText(16, 26, "start", 18, "A spot sweeps from one wall to the next in ten seconds");
    for (size_t v = 0; v < kSweepVariants.size(); ++v) {
        const double left = 24 + double(v) * 260;
        out += fmt::format("<circle cx='{:.1f}' cy='44' r='5' fill='{}'/>\n", left, kColors[v]);
        out += svgText(left + 12, 48, "start", 13, kSweepVariants[v]);
    }
    out += panel(frames, &SweepFrame::spread, 0, "spread of the clusters' areas over their mean");
    out += panel(frames, &SweepFrame::error, kWidth, "relative RMSE of irradiance against all texels");
    return out + "</svg>\n";
}

}  // namespace ag::bench
