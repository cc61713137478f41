#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "engine/core/near_name.h"
#include "engine/core/safe_file.h"
#include "engine/core/settings.h"
#include "engine/renderer/frame_budget.h"
#include "engine/renderer/renderer.h"
#include "tools/viewer/truth_view.h"
#include "tools/workbench/commands.h"
#include "tools/workbench/layers.h"
#include "tools/workbench/pass_times.h"
#include "tools/workbench/progress_line.h"
#include "tools/workbench/render_setup.h"
#include "tools/workbench/session.h"
#include "tools/workbench/turntable.h"

namespace ag::workbench {
namespace {

struct RenderOptions {
    SceneOptions scene;
    std::string session;
    std::string output;
    std::string layer;
    uint32_t frames = 64;
    std::string preset;
    std::vector<std::string> assignments;
    bool listSettings = false;
    bool times = false;
    std::string walk;        // DX,DY,DZ
    uint32_t turntable = 0;  // pictures; 0: one, of the view as it is
    double budgetMs = 0;
    bool validate = false;
    std::vector<std::string> without;
    uint32_t sharedLanes = 0;
    std::string async = "on";
    std::string fault;
};

gpu::AsyncQueue asyncQueueOf(std::string_view name) {
    if (name == "alone") return gpu::AsyncQueue::kAlone;
    return name == "off" ? gpu::AsyncQueue::kOff : gpu::AsyncQueue::kOn;
}

bool writesPng(const RenderOptions& options) {
    return options.turntable > 0 || std::filesystem::path(options.output).extension() == ".png";
}

std::string layerOf(const RenderOptions& options) {
    if (!options.layer.empty()) return options.layer;
    return writesPng(options) ? "final" : "radiance";
}

std::string pictureOfTurn(const RenderOptions& options, uint32_t index) {
    return (std::filesystem::path(options.output) / fmt::format("{:03}.png", index)).string();
}

// --budget-ms: the quality follows what frames take.
class Budget {
  public:
    Budget(double ms, render::RenderSettings& gi) : controller_(ms, render::firstFullSizeStep()) {
        if (ms > 0) render::applyQualityStep(render::qualitySteps()[controller_.step()], gi);
    }
    void follow(render::Renderer& renderer, render::RenderSettings& gi) {
        lastMs_ = cost_.add(renderer.graph().report(), renderer.timesArePartial());
        if (controller_.frame(lastMs_))
            render::applyQualityStep(render::qualitySteps()[controller_.step()], gi);
    }
    void print() const {
        std::cout << fmt::format("budget {:.1f} ms: quality step {}, passes of a whole frame {:.1f} ms\n",
                                 controller_.budgetMs(), render::qualitySteps()[controller_.step()].name,
                                 lastMs_);
    }

  private:
    render::BudgetController controller_;
    render::FrameCost cost_;
    double lastMs_ = 0;
};

// LAYER or LAYER:radiance: an irradiance as the radiance that a Lambert surface sends on, albedo / pi times
// it.
struct AskedLayer {
    render::Layer layer{};
    bool asRadiance = false;
};

Result<AskedLayer> parseLayer(const RenderOptions& options) {
    const std::string text = layerOf(options);
    const LayerName name = splitLayerName(text);
    const auto layer = render::layerFromName(name.layer);
    if (!layer) return Error{missingName("layer", name.layer, layerNames())};
    if (name.asRadiance && !render::layerInfo(*layer).isIrradiance)
        return Error{fmt::format("layer {} is no irradiance that ':radiance' could be taken of", name.layer)};
    if (!name.known) return Error{fmt::format("a layer is NAME or NAME:radiance, not '{}'", text)};
    return AskedLayer{*layer, name.asRadiance};
}

// -o DIR of a turntable, which is made if it is not there.
Status prepareFolder(const RenderOptions& o) {
    if (o.layer.ends_with(":radiance")) return Error{"radiance of a layer is written as .exr or .pfm"};
    std::error_code error;
    std::filesystem::create_directories(o.output, error);
    if (error) return Error{fmt::format("{}: {}", o.output, error.message())};
    return checkWritable(pictureOfTurn(o, 0));
}

Status checkOptions(const RenderOptions& o) {
    if (o.scene.scene.empty()) return Error{"render needs a SCENE"};
    if (o.output.empty()) return Error{"render needs -o FILE.(exr|pfm|png)"};
    if (o.turntable > 0) return prepareFolder(o);
    const std::string extension = std::filesystem::path(o.output).extension();
    if (extension != ".png" && extension != ".exr" && extension != ".pfm")
        return Error{fmt::format("{} must end in .exr, .pfm or .png", o.output)};
    if (extension == ".png" && o.layer.ends_with(":radiance"))
        return Error{"radiance of a layer is written as .exr or .pfm"};
    return checkWritable(o.output);
}

// Why a layer is not there; empty where it is, or where black is the truth.
std::string whyMissing(const RenderOptions& o, const RenderScene& scene, const render::RenderFrame& frame,
                       render::Layer layer) {
    if (render::hasLayer(frame, layer)) return "";
    const bool lit = std::ranges::any_of(scene.lights, [&](const RenderLight& l) {
        return l.bounces || layer == render::Layer::kDirect || layer == render::Layer::kIrradiance;
    });
    const render::LayerInfo& info = render::layerInfo(layer);
    if (!lit && info.isIrradiance) return "";
    return lit ? fmt::format("preset {} makes no layer {} ({}) of {}", o.preset, info.name, info.meaning,
                             o.scene.scene)
               : fmt::format("{} has no light that bounces, so there is no layer {}", o.scene.scene,
                             info.name);
}

// What the frames leave: handles to read back.
struct Shown {
    ImageHandle image, albedo;
    std::string missing;  // why there is no image
};

class Rendering {
  public:
    Rendering(const RenderOptions& options, AskedLayer asked, gpu::Device& device, LoadedScene& loaded,
              RenderSetup& settings)
        : options_(options), asked_(asked), renderer_(device), loaded_(loaded), settings_(settings) {
        renderer_.load(loaded.asset->geometry);
    }

    // `walk`: m the camera moves in each frame; it arrives at the view with the last one.
    Status run(glm::vec3 walk) {
        ProgressLine line("render ");
        Budget budget(options_.budgetMs, settings_.gi);
        const uint32_t frames = std::max(options_.frames, 1u);
        const RenderCamera end = loaded_.scene.camera;
        for (uint32_t i = 0; i < frames; ++i) {
            if (walk != glm::vec3(0)) {
                loaded_.scene.camera = end;
                shiftCamera(loaded_.scene, -float(frames - 1 - i) * walk);
            }
            if (options_.budgetMs > 0 && i > 0) budget.follow(renderer_, settings_.gi);
            renderFrame();
            if (!shown_.missing.empty()) return Error{shown_.missing};
            line(double(i + 1) / frames);
        }
        if (options_.budgetMs > 0) budget.print();
        return Ok{};
    }

    // Pictures all round, each some frames after the camera went on: clusters are carried over.
    Status runTurntable() {
        constexpr uint32_t kFramesOfStep = 8;
        ProgressLine line("turntable ");
        const CameraPose start = poseOf(loaded_.scene);
        for (uint32_t i = 0; i < options_.turntable; ++i) {
            const CameraPose pose = turned(start, loaded_.scene.bounds, loaded_.scene.originWorld,
                                           double(i) / options_.turntable);
            if (i > 0) setCamera(loaded_.scene, pose, loaded_.size);  // the first is the view itself
            for (uint32_t frame = 0; frame < (i == 0 ? options_.frames : kFramesOfStep); ++frame)
                renderFrame();
            if (!shown_.missing.empty()) return Error{shown_.missing};
            if (Status saved = saveImage(image(), pictureOfTurn(options_, i)); !saved) return saved;
            line(double(i + 1) / options_.turntable);
        }
        return Ok{};
    }

    Image image() {
        Image out = shown_.image ? render::readImage(renderer_, shown_.image)
                                 : Image(int(loaded_.size.x), int(loaded_.size.y));
        if (asked_.asRadiance) toRadiance(out, render::readImage(renderer_, shown_.albedo));
        const render::LayerInfo& info = render::layerInfo(asked_.layer);
        out.attributes = layerAttributes(info, asked_.asRadiance);
        out.attributes["scene"] = options_.scene.scene;
        out.attributes["preset"] = options_.preset;
        out.attributes["settings"] = fmt::format("{}", fmt::join(options_.assignments, " "));
        out.attributes["frames"] = std::to_string(options_.frames);
        out.attributes["device"] = renderer_.device().info().name;
        out.attributes["filter"] = reference::filterName(filter());
        return out;
    }

    render::Renderer& renderer() { return renderer_; }

  private:
    reference::PixelFilter filter() const {
        return render::isPicture(asked_.layer) ? viewer::filterOf(settings_.gi.antialiasing)
                                               : reference::PixelFilter::kCenter;
    }
    void renderFrame() {
        const bool png = writesPng(options_);
        renderer_.render(
            loaded_.scene, loaded_.size, settings_.gi, settings_.graph,
            [&](GraphScope scope, const render::SceneView& view, const render::RenderFrame& frame) {
                shown_.missing = whyMissing(options_, loaded_.scene, frame, asked_.layer);
                shown_.image = png ? render::addLayerView(scope, view, frame, asked_.layer, loaded_.size,
                                                          settings_.gi.composite)
                                   : render::addLayer(scope, view, frame, asked_.layer);
                if (asked_.asRadiance)
                    shown_.albedo = render::addLayer(scope, view, frame, render::Layer::kAlbedo);
                for (const ImageHandle image : {shown_.image, shown_.albedo})
                    if (image) scope.output(image);
            });
    }

    const RenderOptions& options_;
    const AskedLayer asked_;
    render::Renderer renderer_;
    LoadedScene& loaded_;
    RenderSetup& settings_;
    Shown shown_;
};

// A picture has every bounce; terms are compared one by one.
std::string defaultPreset(const RenderOptions& o) {
    const auto layer = render::layerFromName(layerOf(o));
    const bool all = layer && render::isPicture(*layer) && o.budgetMs == 0;
    return all ? "afterglow-bounces" : "afterglow";
}

int runRender(RenderOptions options) {
    if (options.preset.empty() && options.session.empty()) options.preset = defaultPreset(options);
    if (const Status used = useSession(options.session, options.scene, options.preset, options.assignments);
        !used)
        return refuse(used.error().message);
    RenderSetup settings;
    const bool asViewed = options.session.empty() && layerOf(options) == "final";
    if (asViewed) {
        settings.gi.antialiasing.mode = render::Antialiasing::kTemporal;
        settings.gi.exposure.automatic = true;
    }
    if (const Status set = settings.apply(options.preset, options.assignments); !set)
        return refuse(set.error().message);
    if (options.listSettings) {
        std::cout << settings.registry.table();
        return 0;
    }
    if (const Status good = checkOptions(options); !good) return refuse(good.error().message);
    const auto asked = parseLayer(options);
    if (!asked) return refuse(asked.error().message);
    settings.gi = render::settingsOf(asked->layer, settings.gi);
    const auto walk = parseStep(options.walk);
    if (!walk) return refuse(walk.error().message);
    auto loaded = loadScene(options.scene, asViewed ? MissingLight::kSunAndSky : MissingLight::kSun);
    if (!loaded) return refuse(loaded.error().message);
    const auto fault = gpu::parseFaultPlan(options.fault);
    if (!fault) return refuse(fault.error().message);
    auto device = gpu::Device::create({.validation = options.validate,
                                       .without = options.without,
                                       .sharedLanes = options.sharedLanes,
                                       .asyncQueue = asyncQueueOf(options.async),
                                       .fault = *fault});
    if (!device) return refuse(device.error().message);

    Rendering rendering(options, *asked, **device, *loaded, settings);
    if (options.turntable > 0) {
        if (const Status done = rendering.runTurntable(); !done) return refuse(done.error().message);
        return (*device)->validationMessageCount() == 0 ? 0 : 1;
    }
    const glm::vec3 arriving = options.times ? glm::vec3(0) : *walk;
    if (const Status done = rendering.run(arriving); !done) return refuse(done.error().message);
    if (const Status saved = saveImage(rendering.image(), options.output); !saved)
        return refuse(saved.error().message);
    if (options.times && *walk != glm::vec3(0))
        printTimesOfWalk(rendering.renderer(), *loaded, settings, *walk);
    else if (options.times)
        printTimes(rendering.renderer(), *loaded, settings);
    return (*device)->validationMessageCount() == 0 ? 0 : 1;
}

}  // namespace

void addRenderCommand(CLI::App& program, int& exitCode) {
    const auto options = std::make_shared<RenderOptions>();
    CLI::App* command = program.add_subcommand("render", "one converged frame of a scene, without a window");
    addSceneOptions(*command, options->scene);
    command->get_option("scene")->required(false);
    command->add_option("-o,--output", options->output, "FILE.(exr|pfm|png)");
    command->add_option("--frames", options->frames, "frames to run first")
        ->check(numberFrom(1, 100000))
        ->capture_default_str();
    command->add_option(
        "--layer", options->layer,
        "which intermediate; radiance (exr, pfm) or final (png) by default; final has automatic "
        "exposure and anti-aliasing unless set otherwise");
    command->footer(layerTable());
    command
        ->add_option("--preset", options->preset, fmt::format("{}", fmt::join(render::presetNames(), ", ")))
        ->default_str("afterglow, with all bounces (afterglow-bounces) for final and radiance");
    command
        ->add_option("--budget-ms", options->budgetMs,
                     "choose the quality so that a frame's passes take about so long")
        ->check(numberFrom(0.1, 100000))
        ->excludes("--preset");
    command->add_option("--set", options->assignments, "group.name=value")->allow_extra_args(false);
    command->add_option("--session", options->session, "what the viewer saved; other options go on top");
    command->add_flag("--list-settings", options->listSettings,
                      "every setting with default, range, unit, help");
    command->add_option(
        "--walk", options->walk,
        "DX,DY,DZ, m the camera moves in each frame: it arrives at the view with the last one; "
        "with --times: in each frame measured");
    CLI::Option* turntable =
        command
            ->add_option("--turntable", options->turntable,
                         "so many pictures once round the scene, or round the view where it is inside: -o is "
                         "a folder of 000.png and so on")
            ->check(numberFrom(2, 999));
    command->add_flag("--times", options->times, "print each pass's process CPU time and the memory used");
    turntable->excludes("--times", "--budget-ms");
    command
        ->add_option("--without", options->without,
                     "run as if the device lacked this feature, or had no more of a limit: LIMIT=N")
        ->allow_extra_args(false);
    command
        ->add_option("--shared-lanes", options->sharedLanes,
                     "workgroups of so many lanes that share memory, in the place of subgroups")
        ->check(CLI::IsMember({4, 8, 16, 32, 64}));
    command
        ->add_option(
            "--async", options->async,
            "indirect light on a second queue: on, where the device has one; off; alone, as work of its "
            "own on the one queue")
        ->check(CLI::IsMember({"on", "off", "alone"}))
        ->capture_default_str();
    command->add_option("--fault", options->fault, "for tests: make the device fail, KIND:N")->group("");
    command->add_flag("--validate", options->validate, "with Vulkan validation; any message exits with 1");
    command->callback([options, &exitCode] { exitCode = runRender(*options); });
}

}  // namespace ag::workbench
