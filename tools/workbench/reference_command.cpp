#include <fmt/format.h>

#include <chrono>
#include <iostream>
#include <map>

#include "common/tonemap.h"
#include "engine/core/image.h"
#include "engine/core/safe_file.h"
#include "tools/reference/ray_speed.h"
#include "tools/reference/reference.h"
#include "tools/workbench/commands.h"
#include "tools/workbench/layers.h"
#include "tools/workbench/progress_line.h"
#include "tools/workbench/scene_options.h"

namespace ag::workbench {
namespace {

using Clock = std::chrono::steady_clock;

struct ReferenceOptions {
    SceneOptions scene;
    std::string output;
    reference::ReferenceSettings settings;
    bool bareSpeed = false;
    std::string filter;  // empty: what the layer takes
};

Status checkOptions(const ReferenceOptions& o, const LayerName& layer) {
    const reference::PathSettings& paths = o.settings.paths;
    if (!layer.known)
        return Error{fmt::format("a layer is NAME or NAME:radiance, not '{}'", o.settings.layer)};
    if (const Status known = reference::checkLayer(layer.layer, paths.bounces); !known) return known;
    if (layer.asRadiance && !referenceLayerInfo(layer.layer).isIrradiance)
        return Error{
            fmt::format("layer {} is no irradiance that ':radiance' could be taken of", layer.layer)};
    const bool emitters = o.settings.method == reference::Method::kEmitters;
    if (emitters && (paths.bounces != 1 || paths.glossy))
        return Error{"--method vpl traces exactly one bounce between Lambert surfaces"};
    if (paths.unshadowed && (emitters || paths.bounces != 1))
        return Error{"--unshadowed traces exactly one bounce by paths"};
    if (!o.filter.empty() && !reference::filterFromName(o.filter))
        return Error{fmt::format("a filter is center, box or blackman-harris, not '{}'", o.filter)};
    return checkWritable(o.output);
}

// A picture is filtered; terms are compared at pixel centres, where the renderer has them.
reference::PixelFilter filterOf(const ReferenceOptions& o, const LayerName& layer) {
    const bool centersOnly = o.settings.method == reference::Method::kEmitters || o.settings.paths.unshadowed;
    if (const auto named = reference::filterFromName(o.filter)) return *named;
    const bool picture = layer.layer == "radiance" && !centersOnly;
    return picture ? reference::PixelFilter::kBox : reference::PixelFilter::kCenter;
}

Image imageOf(const ReferenceOptions& o, const LayerName& layer, const reference::ReferenceSettings& settings,
              const reference::Reference& result) {
    Image image = *reference::layerOf(result, layer.layer);
    if (layer.asRadiance) toRadiance(image, result.albedo);
    const render::LayerInfo info = referenceLayerInfo(layer.layer);
    const bool light = info.isIrradiance || layer.layer == "radiance";
    if (light && o.output.ends_with(".png"))
        for (glm::vec3& p : image.pixels)
            p = io::applyTonemap(p, 1, uint32_t(render::CompositeSettings{}.tonemap));
    image.attributes = layerAttributes(info, layer.asRadiance);
    const reference::PathSettings& paths = settings.paths;
    image.attributes.insert({{"scene", o.scene.scene},
                             {"method", settings.method == reference::Method::kEmitters ? "vpl" : "path"},
                             {"filter", std::string(reference::filterName(paths.filter))},
                             {"visibility", paths.unshadowed ? "direct" : "all"},
                             {"material", paths.glossy ? "glossy" : "lambert"},
                             {"bounces", std::to_string(paths.bounces)},
                             {"samples", std::to_string(result.samples)},
                             {"seed", std::to_string(settings.seed)},
                             {"noise", fmt::format("{:.6g}", result.noise)}});
    return image;
}

int runReference(const ReferenceOptions& o) {
    const LayerName layer = splitLayerName(o.settings.layer);
    if (const Status good = checkOptions(o, layer); !good) return refuse(good.error().message);
    reference::ReferenceSettings settings = o.settings;
    settings.layer = layer.layer;
    settings.paths.filter = filterOf(o, layer);
    auto loaded = loadScene(o.scene);
    if (!loaded) return refuse(loaded.error().message);
    const reference::RayScene rays(loaded->scene);
    JobRunner runner;
    ProgressLine line;
    const auto progress = [&](double share) { line(share); };
    const auto start = Clock::now();
    const reference::Reference result =
        reference::makeReference(rays, loaded->size, settings, runner, progress);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (const Status saved = saveImage(imageOf(o, layer, settings, result), o.output); !saved)
        return refuse(saved.error().message);
    const double raysPerSecond = double(result.rays) / seconds;
    std::cout << fmt::format(
        "{}: {} bounces, {} {} a pixel, noise {:.4f} (relative RMSE of {}), {:.2f} Mrays/s, {:.1f} s\n",
        o.output, settings.paths.bounces, result.samples,
        settings.method == reference::Method::kEmitters ? "emitters" : "paths", result.noise, settings.layer,
        raysPerSecond * 1e-6, seconds);
    if (o.bareSpeed) {
        const double bare = reference::bareRaysPerSecond(rays, loaded->size, runner);
        std::cout << fmt::format("bare Embree loop: {:.2f} Mrays/s; the reference reaches {:.0f} % of it\n",
                                 bare * 1e-6, 100 * raysPerSecond / bare);
    }
    return 0;
}

}  // namespace

void addReferenceCommand(CLI::App& program, int& exitCode) {
    const auto o = std::make_shared<ReferenceOptions>();
    CLI::App* command = program.add_subcommand("reference", "the same picture by path tracing on the CPU");
    addSceneOptions(*command, o->scene);
    command->footer(referenceLayerTable());
    command->add_option("-o,--output", o->output, "FILE.(exr|pfm)")->required();
    reference::ReferenceSettings& r = o->settings;
    command
        ->add_option("--layer", r.layer,
                     "radiance, irradiance, direct, emissive, sky, bounce1 to bounce8, indirect (or "
                     "bounces), albedo, normal "
                     "or depth")
        ->capture_default_str();
    command->add_option("--bounces", r.paths.bounces, "most bounces of a path")
        ->check(numberFrom(0, 1000))
        ->capture_default_str();
    command->add_option("--spp", r.samplesPerPixel, "paths a pixel, at most")
        ->check(numberFrom(2, 1e7))
        ->capture_default_str();
    command->add_option("--max-error", r.maxError, "stop when the layer's estimated relative error is less")
        ->check(numberFrom(1e-6, 1000));
    command->add_option("--seed", r.seed, "of the random numbers")->capture_default_str();
    command->add_option("--method", r.method, "path, or vpl: RSM texels as point emitters")
        ->transform(CLI::CheckedTransformer(std::map<std::string, reference::Method>{
            {"path", reference::Method::kPaths}, {"vpl", reference::Method::kEmitters}}));
    command->add_option("--vpl-map", r.emitterMap, "texels along an RSM's side")
        ->check(numberFrom(1, 1024))
        ->capture_default_str();
    command->add_flag("--glossy", r.paths.glossy, "whole glTF materials instead of their Lambert part");
    command->add_flag("--unshadowed", r.paths.unshadowed,
                      "bounced light passes through surfaces: the aim of techniques without its visibility");
    command->add_flag("!--no-lit-points", r.paths.litPoints,
                      "look for bounced light from the camera alone: another estimate of the same");
    command->add_option("--filter", o->filter,
                        "of pixels: center, box or blackman-harris; box for radiance, else center");
    command->add_flag("!--no-emission", r.paths.emission, "emissive surfaces are seen but light nothing");
    command->add_flag("--bare-speed", o->bareSpeed, "print also what bare Embree calls reach here");
    command->callback([o, &exitCode] { exitCode = runReference(*o); });
}

}  // namespace ag::workbench
