#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>
#include <iostream>

#include "engine/core/settings.h"
#include "tools/capture/display.h"
#include "tools/capture/folder.h"
#include "tools/capture/pass_table.h"
#include "tools/capture/record.h"
#include "tools/capture/trace.h"
#include "tools/workbench/commands.h"
#include "tools/workbench/scene_options.h"

namespace ag::workbench {
namespace {

struct CaptureOptions {
    SceneOptions scene;
    std::string output;
    std::string preset = "afterglow";
    std::vector<std::string> assignments;
    uint32_t frames = 32, warmUp = 6;
    std::string walk;    // DX,DY,DZ
    std::string repeat;  // PASS=N
    bool exr = false, validate = false;
};

// Status of everything the options say beyond the scene.
Status readSettings(const CaptureOptions& o, capture::RecordSettings& settings, std::string& repeatPass) {
    if (!gi::applyPreset(o.preset, settings.gi))
        return Error{fmt::format("there is no preset '{}' (there are: {})", o.preset,
                                 fmt::join(gi::presetNames(), ", "))};
    Settings registry;
    registry.add({"engine", "skip", 0, 0, "", "leave out passes whose inputs did not change"},
                 &settings.graph.skip);
    registry.add({"engine", "alias", 0, 0, "", "scratch images share memory"}, &settings.graph.alias);
    gi::registerSettings(registry, settings.gi);
    for (const std::string& assignment : o.assignments)
        if (const Status set = registry.set(assignment); !set) return set.error();
    settings.frames = o.frames;
    settings.warmUp = o.warmUp;
    if (o.repeat.empty()) return Ok{};
    const size_t at = o.repeat.find('=');
    const int times = at == std::string::npos ? 0 : std::atoi(o.repeat.c_str() + at + 1);
    if (times < 1 || times > 10000)
        return Error{fmt::format("--repeat takes PASS=N with N from 1 to 10000, not '{}'", o.repeat)};
    repeatPass = o.repeat.substr(0, at);
    settings.graph.repeatPass = repeatPass;
    settings.graph.repeats = uint32_t(times);
    return Ok{};
}

void moveCamera(RenderScene& scene, glm::vec3 step) {
    RenderCamera& camera = scene.camera;
    camera.position += step;
    camera.clipFromWorld = glm::translate(camera.clipFromWorld, -step);
    camera.worldFromClip = glm::inverse(camera.clipFromWorld);
    ++scene.cameraVersion;
}

std::string settingsText(const CaptureOptions& o) {
    return fmt::format("preset {}{}{}{}", o.preset, o.assignments.empty() ? "" : ", ",
                       fmt::join(o.assignments, ", "), o.walk.empty() ? "" : ", walking " + o.walk);
}

Status writePictures(capture::Folder& folder, const capture::Capture& seen, bool exr) {
    for (const capture::Picture& picture : seen.pictures) {
        const Image shown = capture::displayOf(picture, seen.cameraNear);
        if (const Status s = folder.writeImage(picture.name + ".png", shown); !s) return s;
        if (!exr) continue;
        if (const Status s = folder.writeImage(picture.name + ".exr", picture.pixels); !s) return s;
    }
    return folder.writeText("pictures.csv", capture::picturesCsv(seen.pictures));
}

Status writeCapture(capture::Folder& folder, const capture::Capture& seen,
                    const std::vector<capture::PassRow>& table, bool exr) {
    if (const Status s = folder.writeText("passes.csv", capture::tableCsv(table)); !s) return s;
    if (const Status s = folder.writeText("trace.json", capture::traceJson(seen)); !s) return s;
    if (const Status s = writePictures(folder, seen, exr); !s) return s;
    return folder.commit();
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

int runCapture(const CaptureOptions& o) {
    if (o.output.empty()) return refuse("capture needs -o DIR");
    capture::RecordSettings settings;
    std::string repeatPass;
    if (const Status read = readSettings(o, settings, repeatPass); !read) return refuse(read.error().message);
    const auto walk = parseStep(o.walk);
    if (!walk) return refuse(walk.error().message);
    auto loaded = loadScene(o.scene);
    if (!loaded) return refuse(loaded.error().message);
    auto device = gpu::Device::create({.validation = o.validate});
    if (!device) return refuse(device.error().message);
    auto folder = capture::Folder::open(o.output);
    if (!folder) return refuse(folder.error().message);

    gi::GiRenderer renderer(**device);
    renderer.load(loaded->asset->geometry);
    settings.size = loaded->size;
    capture::Capture seen{.scene = o.scene.scene,
                          .device = (*device)->info().name,
                          .driver = (*device)->info().driver,
                          .settings = settingsText(o),
                          .size = loaded->size};
    const auto next = [&](std::vector<capture::Span>&) -> const RenderScene& {
        if (*walk != glm::vec3(0)) moveCamera(loaded->scene, *walk);
        return loaded->scene;
    };
    capture::recordFrames(renderer, next, settings, seen);
    capture::recordPictures(renderer, loaded->scene, settings, seen);
    const std::vector<capture::PassRow> table = capture::makeTable(seen);
    if (!repeatPass.empty() && std::ranges::count(table, repeatPass, &capture::PassRow::name) == 0)
        return refuse(fmt::format("no pass of the frame is named '{}'", repeatPass));
    if (const Status written = writeCapture(*folder, seen, table, o.exr); !written)
        return refuse(written.error().message);
    printSummary(o, seen, table);
    return (*device)->validationMessageCount() == 0 ? 0 : 1;
}

}  // namespace

void addCaptureCommand(CLI::App& program, int& exitCode) {
    const auto o = std::make_shared<CaptureOptions>();
    CLI::App* command = program.add_subcommand(
        "capture", "where a frame's time goes: a trace, a table of passes, every intermediate");
    addSceneOptions(*command, o->scene);
    command->add_option("-o,--output", o->output, "DIR to write into; made if need be");
    command->add_option("--frames", o->frames, "frames to measure")
        ->check(CLI::Range(1u, 10000u))
        ->capture_default_str();
    command
        ->add_option("--warm-up", o->warmUp,
                     "frames before them in which nothing is skipped, so that every pass gets a time")
        ->check(CLI::Range(1u, 1000u))
        ->capture_default_str();
    command->add_option("--preset", o->preset, fmt::format("{}", fmt::join(gi::presetNames(), ", ")))
        ->capture_default_str();
    command->add_option("--set", o->assignments, "group.name=value")->allow_extra_args(false);
    command->add_option("--walk", o->walk, "DX,DY,DZ, m the camera moves in each frame");
    command->add_option("--repeat", o->repeat,
                        "PASS=N: do a pass's work N times over, to see what making it slower does");
    command->add_flag("--exr", o->exr, "every intermediate as EXR, too");
    command->add_flag("--validate", o->validate, "with Vulkan validation; any message exits with 1");
    command->callback([o, &exitCode] { exitCode = runCapture(*o); });
}

}  // namespace ag::workbench
