// The demo: a dark gallery and a lamp in your hand. WASD walk, the mouse looks (held button: it moves the
// lamp), 1-9 show intermediates, F1 settings, F2 passes, Esc frees the mouse and, again, quits.
#include <CLI/CLI.hpp>

#include "engine/core/log.h"
#include "engine/scene/gltf_import.h"
#include "game/demo_options.h"

namespace ag::game {
namespace {

constexpr const char* kLevel = AFTERGLOW_SOURCE_DIR "/game/level/gallery.glb";
constexpr const char* kTour = AFTERGLOW_SOURCE_DIR "/game/level/tour.replay";

bool parseSize(const std::string& text, glm::uvec2& size) {
    char end = 0;
    return std::sscanf(text.c_str(), "%ux%u%c", &size.x, &size.y, &end) == 2 && size.x > 0 && size.y > 0 &&
           size.x <= 8192 && size.y <= 8192;
}

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
    program.add_option("--report", o.report, "save a report of the passes and times");
    program.add_option("--view", o.view, "show this intermediate instead of the final image");
    program.add_option("--set", o.assignments, "group.name=value")
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    program.add_flag("--serial", o.serial, "one thread, systems in order");
    program.add_flag("--validate", o.validate, "with Vulkan validation; any message exits with 1");
}

// Everything checked before a device or a window is opened; the sentence that refuses it, if any.
Status prepare(Demo& demo) {
    const DemoOptions& o = demo.options;
    demo.settings.add({"engine", "skip", 0, 0, "", "leave out passes whose inputs did not change"},
                      &demo.graph.skip);
    demo.gi.composite.exposure = 1.0f;  // eyes used to the dark
    gi::registerSettings(demo.settings, demo.gi);
    for (const std::string& assignment : o.assignments)
        if (Status set = demo.settings.set(assignment); !set) return set;
    if (!parseSize(o.sizeText, demo.options.size))
        return Error{"a size is WxH with 1 to 8192 pixels a side, not '" + o.sizeText + "'"};
    if (!o.view.empty()) {
        demo.layer = gi::layerFromName(o.view);
        if (!demo.layer) return Error{"there is no intermediate named '" + o.view + "'"};
    }
    const std::string replay = !o.replay.empty() ? o.replay : o.headless && o.scene.empty() ? kTour : "";
    if (!replay.empty()) {
        auto ticks = loadReplay(replay);
        if (!ticks) return ticks.error();
        demo.replay = std::move(*ticks);
    }
    auto level = importGltf(o.scene.empty() ? kLevel : o.scene);
    if (!level) return level.error();
    for (const std::string& warning : level->warnings)
        spdlog::warn("{}: {}", level->name, warning);
    demo.game = std::make_unique<Game>(std::move(*level), o.serial ? 1 : 0);
    return Ok{};
}

int run(int argc, char** argv) {
    initLogging(false);
    Demo demo;
    CLI::App program("Afterglow: a gallery in the dark", "afterglow-demo");
    addOptions(program, demo.options);
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return program.exit(error);
        return refuse(error.what());
    }
    if (const Status ready = prepare(demo); !ready) return refuse(ready.error().message);
    const int exitCode = demo.options.headless ? runHeadless(demo) : runWindowed(demo);
    if (const Status saved = finishRecording(demo); !saved) return refuse(saved.error().message);
    return exitCode;
}

}  // namespace
}  // namespace ag::game

int main(int argc, char** argv) {
    return ag::game::run(argc, argv);
}
