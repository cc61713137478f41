#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iostream>
#include <mutex>

#include "engine/core/image.h"
#include "tools/reference/path_tracer.h"
#include "tools/workbench/commands.h"
#include "tools/workbench/scene_options.h"

namespace ag::workbench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::array<std::string_view, 8> kLayers = {"radiance", "irradiance", "direct", "bounce1",
                                                     "indirect", "albedo",     "normal", "depth"};

struct ReferenceOptions {
    SceneOptions scene;
    std::string output;
    std::string layer = "radiance";
    reference::PathSettings paths;
};

// A line on stderr, at most twice a second: share done and time left.
class ProgressLine {
  public:
    void operator()(double share) {
        const std::lock_guard lock(mutex_);
        const auto now = Clock::now();
        if (now - last_ < std::chrono::milliseconds(500)) return;
        last_ = now;
        const double spent = std::chrono::duration<double>(now - start_).count();
        std::cerr << fmt::format("\r{:3.0f} %, {:.0f} s left   ", share * 100, spent / share * (1 - share));
        shown_ = true;
    }
    ~ProgressLine() {
        if (shown_) std::cerr << '\n';
    }

  private:
    std::mutex mutex_;
    Clock::time_point start_ = Clock::now(), last_ = start_;
    bool shown_ = false;
};

Image layerOf(const reference::ReferenceImages& r, const std::string& name) {
    if (name == "radiance") return r.radiance();
    if (name == "irradiance") return r.irradiance();
    if (name == "direct") return r.direct;
    if (name == "bounce1") return r.bounce1;
    if (name == "indirect") return r.indirect;
    if (name == "albedo") return r.albedo;
    if (name == "normal") return r.normal;
    return r.depth;
}

// Relative RMSE of one run's mean, from two runs with other seeds: the difference of two equal estimates
// holds the error of both.
double noiseOf(const Image& a, const Image& b) {
    double squares = 0, mean = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double d = double(a.pixels[i][c]) - double(b.pixels[i][c]);
            squares += d * d / 4;  // of their mean
            mean += double(a.pixels[i][c] + b.pixels[i][c]) / 2;
        }
    const double count = double(a.pixels.size()) * 3;
    return mean > 0 ? std::sqrt(squares / count) / (mean / count) : 0;
}

int runReference(const ReferenceOptions& o) {
    if (std::ranges::find(kLayers, o.layer) == kLayers.end())
        return refuse(fmt::format("the reference has no layer '{}'", o.layer));
    auto loaded = loadScene(o.scene);
    if (!loaded) return refuse(loaded.error().message);
    const reference::RayScene rays(loaded->scene);
    JobRunner runner;
    const auto start = Clock::now();
    // Two halves with seeds of their own: their mean is the result, their difference its noise.
    reference::PathSettings half = o.paths;
    half.samplesPerPixel = std::max(o.paths.samplesPerPixel / 2, 1u);
    half.seed = o.paths.seed * 2;
    ProgressLine line;
    const auto progress = [&](double base) {
        return [&line, base](double share) { line(base + share / 2); };
    };
    const auto firstProgress = progress(0), secondProgress = progress(0.5);
    const auto a = reference::tracePaths(rays, loaded->size, half, runner, firstProgress);
    ++half.seed;
    const auto b = reference::tracePaths(rays, loaded->size, half, runner, secondProgress);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    Image result = layerOf(a, o.layer);
    const Image other = layerOf(b, o.layer);
    const double noise = noiseOf(result, other);
    for (size_t i = 0; i < result.pixels.size(); ++i)
        result.pixels[i] = (result.pixels[i] + other.pixels[i]) * 0.5f;
    if (const Status saved = saveImage(result, o.output); !saved) return refuse(saved.error().message);
    std::cout << fmt::format(
        "{}: {} bounces, {} paths a pixel, noise {:.4f} (relative RMSE), {:.2f} Mrays/s, {:.1f} s\n",
        o.output, o.paths.bounces, half.samplesPerPixel * 2, noise, double(a.rays + b.rays) / seconds * 1e-6,
        seconds);
    return 0;
}

}  // namespace

void addReferenceCommand(CLI::App& program, int& exitCode) {
    const auto o = std::make_shared<ReferenceOptions>();
    CLI::App* command = program.add_subcommand("reference", "the same picture by path tracing on the CPU");
    addSceneOptions(*command, o->scene);
    command->add_option("-o,--output", o->output, "FILE.(exr|pfm)")->required();
    command
        ->add_option("--layer", o->layer,
                     "radiance, irradiance, direct, bounce1, indirect, albedo, normal or depth")
        ->capture_default_str();
    command->add_option("--bounces", o->paths.bounces, "most bounces of a path")
        ->check(CLI::Range(0u, 1000u))
        ->capture_default_str();
    command->add_option("--spp", o->paths.samplesPerPixel, "paths a pixel")
        ->check(CLI::Range(2u, 1000000u))
        ->capture_default_str();
    command->add_option("--seed", o->paths.seed, "of the random numbers")->capture_default_str();
    command->callback([o, &exitCode] { exitCode = runReference(*o); });
}

}  // namespace ag::workbench
