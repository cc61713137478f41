// The demo: a dark gallery, a lamp in your hand, and flowers that open in light that has bounced. Esc is the
// menu; 1-9 show intermediates, F1 settings, F2 passes, F3 times, F4 the world, F8 the photo mode, F9 the
// profiler; F10 captures frames.
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <filesystem>

#include "engine/core/log.h"
#include "engine/core/number_option.h"
#include "engine/core/program.h"
#include "engine/core/safe_file.h"
#include "engine/core/spread_sets.h"
#include "game/demo_options.h"
#include "game/replay_notes.h"
#include "game/save_game.h"

namespace ag::game {
namespace {

constexpr const char* kWalkthrough = AFTERGLOW_SOURCE_DIR "/game/level/walkthrough.replay";

void addOptions(CLI::App& program, DemoOptions& o) {
    // The last one counts, so that what follows a script's own options overrides them.
    program.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    program.add_flag("--headless", o.headless, "no window: play the replay and report");
    program.add_option("--frames", o.frames, "stop after so many frames");
    program.add_option("--replay", o.replay, "play these recorded inputs");
    program.add_option("--record", o.record, "record the inputs to this file");
    program.add_option("--size", o.sizeText, "pixels, WxH")->capture_default_str();
    program.add_option("--scene", o.scene, "another level, glTF or GLB");
    program.add_option("--screenshot", o.screenshot, "save the last frame as PNG");
    program.add_option("--moments", o.moments, "save twenty moments of a headless run as one PNG");
    program.add_option("--film", o.film, "save sixty frames in a row of a headless run as one PNG");
    program.add_option("--film-from", o.filmFrom, "the first of them, from 0; the run's middle by default")
        ->check(numberFrom(0, 1e9))
        ->needs("--film");
    program.add_option("--ticks-per-frame", o.ticksPerFrame, "headless: ticks of 1/60 s for each frame")
        ->check(numberFrom(1, 60))
        ->capture_default_str();
    program.add_option("--quality", o.quality, "low, medium, high, ultra or auto");
    program
        .add_option("--budget-ms", o.budgetMs,
                    "choose the quality so that a frame's passes take about so long; instead of --quality")
        ->check(numberFrom(0.1, 100000))
        ->excludes("--quality");
    program.add_option("--user", o.userFolder, "folder of the save, the keys and the settings");
    program.add_flag("--continue", o.resume, "go on with the saved game");
    program.add_option("--chapter", o.chapter, "start in this room, from 1: all before it are solved")
        ->check(numberFrom(1, 1000))
        ->excludes("--continue");
    program.add_option("--report", o.report, "save a report of the passes and times");
    program.add_option("--view", o.view, "show this intermediate instead of the final image");
    program.add_option("--set", o.assignments, "group.name=value")
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    program.add_option("--capture-frames", o.captureFrames, "how many frames F10 captures")
        ->check(numberFrom(1, 1000))
        ->capture_default_str();
    program.add_flag("--renderdoc", o.renderDoc, "load RenderDoc, so that F10 leaves frame.rdc, too");
    program.add_flag("--serial", o.serial, "one thread, systems in order, each frame waits for the device");
    program.add_option("--without", o.without, "run as if the device lacked this feature")
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    program.add_option("--fault", o.fault, "for tests: make the device fail, KIND:N")->group("");
    program.add_flag("--validate", o.validate, "with Vulkan validation; any message exits with 1");
}

// A file that is there must be good; one that is not is no fault.
template <class T>
Status loadIfThere(const std::string& path, Result<T> (*load)(const std::string&), T& into) {
    if (!fileExists(path)) return Ok{};
    auto loaded = load(path);
    if (!loaded) return loaded.error();
    into = *loaded;
    return Ok{};
}

Status readUserFiles(Demo& demo) {
    const DemoOptions& o = demo.options;
    demo.files.folder = o.userFolder.empty() ? userFolder() : o.userFolder;
    std::error_code ignored;
    if (fileExists(demo.files.folder) && !std::filesystem::is_directory(demo.files.folder, ignored))
        return Error{demo.files.folder + ": it is not a folder"};
    // Nobody's wishes change what a run without a window shows.
    if (!o.headless || !o.userFolder.empty()) {
        if (Status s = loadIfThere(demo.files.keys(), loadBindings, demo.keys); !s) return s;
        if (Status s = loadIfThere(demo.files.settings(), loadUserSettings, demo.user); !s) return s;
    }
    if (o.quality.empty()) return Ok{};
    const auto quality = qualityFromName(o.quality);
    if (!quality) return Error{"a quality is low, medium, high, ultra or auto, not '" + o.quality + "'"};
    demo.user.quality = *quality;
    return Ok{};
}

Status readReplay(Demo& demo) {
    const DemoOptions& o = demo.options;
    const std::string replay = !o.replay.empty()                                          ? o.replay
                               : o.headless && o.scene.empty() && !o.resume && !o.chapter ? kWalkthrough
                                                                                          : "";
    if (replay.empty()) return Ok{};
    auto loaded = loadReplay(replay);
    if (!loaded) return loaded.error();
    demo.replay = std::move(*loaded);
    return Ok{};
}

// Everything checked before a device or a window is opened; the sentence that refuses it, if any.
Status prepare(Demo& demo) {
    const DemoOptions& o = demo.options;
    demo.settings.add({"engine", "skip", 0, 0, "", "leave out passes whose inputs did not change"},
                      &demo.graph.skip);
    demo.settings.add({"sound", "volume", 0, 1, "", "of the sound; 0 opens no sound device"},
                      &demo.sound.volume);
    render::registerSettings(demo.settings, demo.gi);
    openEyes(demo.gi);
    for (const std::string& assignment : o.assignments)
        if (Status set = demo.settings.set(assignment); !set) return set;
    const auto size = parseSize(o.sizeText);
    if (!size) return size.error();
    demo.options.size = *size;
    if (!o.view.empty()) {
        demo.layer = render::layerFromName(o.view);
        if (!demo.layer) return Error{"there is no intermediate named '" + o.view + "'"};
    }
    const auto fault = gpu::parseFaultPlan(o.fault);
    if (!fault) return fault.error();
    demo.fault = *fault;
    if (o.resume && !o.record.empty()) return Error{"a recording starts with the level, not with --continue"};
    if (Status s = readUserFiles(demo); !s) return s;
    if (Status s = checkWritable({o.record, o.screenshot, o.moments, o.film, o.report}); !s) return s;
    if (Status s = readReplay(demo); !s) return s;
    if (o.budgetMs > 0) demo.user.quality = Quality::kAutomatic;
    useQuality(demo, demo.user.quality, render::qualitySteps()[render::firstFullSizeStep()]);
    if (Status s = loadLevel(demo); !s) return s;
    if (Status s = checkReplay(demo); !s) return s;
    if (o.chapter > 0 && !o.record.empty())
        return Error{"a recording starts with the level, not with --chapter"};
    if (o.chapter > 0 && !startAtRoom(*demo.game, int32_t(o.chapter) - 1))
        return Error{fmt::format("the level has no room {}", o.chapter)};
    return o.resume ? continueGame(*demo.game, demo.files.save()) : Status(Ok{});
}

int run(int argc, char** argv) {
    Demo demo;
    CLI::App program("Afterglow: a gallery in the dark", "afterglow-demo");
    addOptions(program, demo.options);
    try {
        program.parse(reversedArguments({argv, size_t(argc)}));
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return program.exit(error);
        return refuse(error.what());
    }
    if (const Status ready = prepare(demo); !ready) return refuse(ready.error().message);
    onProgramEnd([&demo] {
        if (const Status kept = finishRecording(demo); !kept) spdlog::error("{}", kept.error().message);
    });
    const int exitCode = demo.options.headless ? runHeadless(demo) : runWindowed(demo);
    if (const Status saved = finishRecording(demo); !saved) return refuse(saved.error().message);
    return exitCode;
}

}  // namespace
}  // namespace ag::game

int main(int argc, char** argv) {
    return ag::runProgram([&] { return ag::game::run(argc, argv); });
}
