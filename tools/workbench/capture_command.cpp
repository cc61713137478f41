#include <fmt/format.h>

#include <iostream>

#include "engine/capture/diff.h"
#include "engine/capture/record.h"
#include "engine/capture/save_capture.h"
#include "engine/capture/schedule_spans.h"
#include "engine/capture/world_source.h"
#include "engine/core/settings.h"
#include "tools/reference/reference.h"
#include "tools/workbench/commands.h"
#include "tools/workbench/render_setup.h"
#include "tools/workbench/session.h"

namespace ag::workbench {
namespace {

struct CaptureOptions {
    SceneOptions scene;
    std::string output;
    std::string preset, session;
    std::vector<std::string> assignments;
    uint32_t frames = 32, warmUp = 6;
    std::string walk;    // DX,DY,DZ
    std::string repeat;  // PASS=N
    bool exr = false, validate = false;
    bool renderDoc = false;
    bool schedule = false;
    bool reference = false;
    uint32_t referenceSpp = 64;
    std::vector<std::string> diff;  // two folders
    capture::DiffSettings diffSettings;
};

// What the options say beyond the scene. Refers to their text.
struct CapturePlan {
    capture::RecordSettings settings;
    glm::vec3 walk{0};  // m the camera moves in each frame
};

Result<CapturePlan> readPlan(const CaptureOptions& o) {
    CapturePlan plan;
    capture::RecordSettings& settings = plan.settings;
    RenderSetup setup;
    if (const Status set = setup.apply(o.preset, o.assignments); !set) return set.error();
    settings.gi = setup.gi;
    settings.graph = setup.graph;
    settings.frames = o.frames;
    settings.warmUp = o.warmUp;
    const auto walk = parseStep(o.walk);
    if (!walk) return walk.error();
    plan.walk = *walk;
    if (o.repeat.empty()) return plan;
    const size_t at = o.repeat.find('=');
    const auto times = parseNumber(at == std::string::npos ? "" : o.repeat.substr(at + 1), 1, 10000, true);
    if (!times) return Error{fmt::format("--repeat takes PASS=N with N from 1 to 10000, not '{}'", o.repeat)};
    settings.graph.repeatPass = std::string_view(o.repeat).substr(0, at);
    settings.graph.repeats = uint32_t(*times);
    return plan;
}

std::string settingsText(const CaptureOptions& o) {
    return fmt::format("preset {}{}{}{}", o.preset, o.assignments.empty() ? "" : ", ",
                       fmt::join(o.assignments, ", "), o.walk.empty() ? "" : ", walking " + o.walk);
}

// What the frame would look like without any error, by path tracing with one bounce.
void addReference(const CaptureOptions& o, const RenderScene& scene, capture::Capture& seen) {
    reference::ReferenceSettings settings;
    settings.samplesPerPixel = o.referenceSpp;
    JobRunner runner;
    const reference::RayScene rays(scene);
    reference::Reference truth = reference::makeReference(rays, seen.size, settings, runner, [](double) {});
    seen.pictures.push_back({.name = "reference", .format = "rgb32f", .pixels = std::move(truth.radiance)});
}

int runDiff(const CaptureOptions& o) {
    const auto a = capture::readCapture(o.diff[0]);
    if (!a) return refuse(a.error().message);
    const auto b = capture::readCapture(o.diff[1]);
    if (!b) return refuse(b.error().message);
    const capture::Diff diff = capture::compareCaptures(*a, *b, o.diffSettings);
    std::cout << capture::diffText(diff);
    return diff.slower.empty() && diff.changed.empty() ? 0 : 1;
}

// The five that cost most, by what they take when they run.
void printSummary(const CaptureOptions& o, const capture::Capture& seen,
                  std::vector<capture::PassRow> table) {
    const auto cost = [](const capture::PassRow& r) { return r.ms.count ? r.ms.median : r.forced.median; };
    std::ranges::stable_sort(table, [&](const auto& a, const auto& b) { return cost(a) > cost(b); });
    std::cout << fmt::format("{}: {} passes, {} pictures, {} frames of {}x{} on {}\n", o.output, table.size(),
                             seen.pictures.size(), o.frames, seen.size.x, seen.size.y, seen.device);
    for (size_t i = 0; i < std::min<size_t>(table.size(), 5); ++i)
        std::cout << fmt::format("{:<36} {:8.3f} ms, skipped in {:3.0f} % of the frames\n", table[i].name,
                                 cost(table[i]), 100 * table[i].skippedShare());
}

// Frames, pictures, graphs of the scene as it is or as entities.
Result<capture::Capture> captureScene(const CaptureOptions& o, const CapturePlan& plan, LoadedScene& loaded,
                                      render::Renderer& renderer, gpu::RenderDoc renderDoc,
                                      const std::string& rdcPath) {
    const capture::RecordSettings& settings = plan.settings;
    const gpu::DeviceInfo& device = renderer.device().info();
    capture::Capture seen{.scene = o.scene.scene,
                          .device = device.name,
                          .driver = device.driver,
                          .settings = settingsText(o),
                          .size = loaded.size};
    std::optional<capture::WorldSource> world;
    if (o.schedule) world.emplace(*loaded.asset, loaded.scene, loaded.size, plan.walk);
    const RenderScene* last = &loaded.scene;
    const auto next = [&](std::vector<capture::Span>& systems) -> const RenderScene& {
        if (world)
            last = &world->next(systems);
        else if (plan.walk != glm::vec3(0))
            shiftCamera(loaded.scene, plan.walk);
        return *last;
    };
    capture::recordFrames(renderer, next, settings, seen);
    if (world) capture::describeSchedule(world->schedule(), seen);
    const Status captured = capture::recordPictures(renderer, *last, settings, renderDoc, rdcPath, seen);
    if (!captured) return captured.error();
    if (o.reference) addReference(o, *last, seen);
    return seen;
}

Status checkOptions(const CaptureOptions& o) {
    const SceneOptions& s = o.scene;
    if (s.scene.empty()) return Error{"capture needs a SCENE"};
    if (o.output.empty()) return Error{"capture needs -o DIR"};
    if (o.schedule && (!s.suns.empty() || !s.points.empty() || !s.spots.empty() || s.hungLamps ||
                       s.noSceneLights || s.lights))
        return Error{"--schedule takes the lights of the scene's file: leave the light options out"};
    return Ok{};
}

int runCapture(CaptureOptions o) {
    if (!o.diff.empty()) return runDiff(o);
    if (const Status used = useSession(o.session, o.scene, o.preset, o.assignments); !used)
        return refuse(used.error().message);
    if (const Status usable = checkOptions(o); !usable) return refuse(usable.error().message);
    auto plan = readPlan(o);
    if (!plan) return refuse(plan.error().message);
    auto loaded = loadScene(o.scene);
    if (!loaded) return refuse(loaded.error().message);
    auto folder = capture::Folder::open(o.output);
    if (!folder) return refuse(folder.error().message);
    const auto renderDoc = gpu::RenderDoc::open(o.renderDoc);  // before the device
    if (!renderDoc) return refuse(renderDoc.error().message);
    auto device = gpu::Device::create({.validation = o.validate});
    if (!device) return refuse(device.error().message);

    render::Renderer renderer(**device);
    renderer.load(loaded->asset->geometry);
    plan->settings.size = loaded->size;
    const std::string rdcPath = *renderDoc ? folder->place("frame.rdc") : "";
    const auto seen = captureScene(o, *plan, *loaded, renderer, *renderDoc, rdcPath);
    if (!seen) return refuse(seen.error().message);
    const std::vector<capture::PassRow> table = capture::makeTable(*seen);
    const std::string_view repeated = plan->settings.graph.repeatPass;
    if (!repeated.empty() && std::ranges::count(table, repeated, &capture::PassRow::name) == 0)
        return refuse(fmt::format("no pass of the frame is named '{}'", repeated));
    if (const Status written = capture::saveCapture(*folder, *seen, table, o.exr); !written)
        return refuse(written.error().message);
    printSummary(o, *seen, table);
    return (*device)->validationMessageCount() == 0 ? 0 : 1;
}

}  // namespace

void addCaptureCommand(CLI::App& program, int& exitCode) {
    const auto o = std::make_shared<CaptureOptions>();
    CLI::App* command = program.add_subcommand(
        "capture", "where a frame's time goes: a trace, a table of passes, every intermediate");
    addSceneOptions(*command, o->scene);
    command->get_option("scene")->required(false);
    command->add_option("-o,--output", o->output, "DIR to write into; made if need be");
    command->add_option("--frames", o->frames, "frames to measure")
        ->check(numberFrom(1, 10000))
        ->capture_default_str();
    command
        ->add_option("--warm-up", o->warmUp,
                     "frames before them in which nothing is skipped, so that every pass gets a time")
        ->check(numberFrom(1, 1000))
        ->capture_default_str();
    command->add_option("--preset", o->preset, fmt::format("{}", fmt::join(render::presetNames(), ", ")))
        ->default_str("afterglow");
    command->add_option("--session", o->session, "what the viewer saved; other options go on top");
    command->add_option("--set", o->assignments, "group.name=value")->allow_extra_args(false);
    command->add_option("--walk", o->walk, "DX,DY,DZ, m the camera moves in each frame");
    command->add_option("--repeat", o->repeat,
                        "PASS=N: do a pass's work N times over, to see what making it slower does");
    command->add_flag("--schedule", o->schedule,
                      "the scene as entities: a schedule moves the camera and extracts each frame");
    command->add_flag("--reference", o->reference, "the frame by path tracing, too, to compare with");
    command->add_option("--reference-spp", o->referenceSpp, "its paths a pixel")
        ->check(numberFrom(2, 1e6))
        ->capture_default_str();
    command
        ->add_option("--diff", o->diff,
                     "A B: compare two captures; exits with 1 if a pass got slower or "
                     "changed its picture")
        ->expected(2);
    command
        ->add_option("--diff-ratio", o->diffSettings.leastRatio,
                     "how many times slower than the other passes counts")
        ->check(numberFrom(1, 1000))
        ->capture_default_str();
    command->add_flag(
        "--renderdoc", o->renderDoc,
        "load RenderDoc for frame.rdc; it is written anyway where the library is loaded already");
    command->add_flag("--exr", o->exr, "every intermediate as EXR, too");
    command->add_flag("--validate", o->validate, "with Vulkan validation; any message exits with 1");
    command->callback([o, &exitCode] { exitCode = runCapture(*o); });
}

}  // namespace ag::workbench
