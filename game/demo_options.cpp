#include "game/demo_options.h"

#include <algorithm>
#include <iostream>

#include "engine/core/log.h"
#include "game/dress_level.h"
#include "game/replay_notes.h"

namespace ag::game {
namespace {

constexpr const char* kLevel = AFTERGLOW_SOURCE_DIR "/game/level/gallery.glb";

}  // namespace

int refuse(const std::string& sentence) {
    std::cerr << "afterglow-demo: " << sentence << '\n';
    return 2;
}

gpu::DeviceOptions deviceOptions(const Demo& demo, std::optional<gpu::WindowSurface> window) {
    return {.validation = demo.options.validate,
            .window = std::move(window),
            .without = demo.options.without,
            .fault = demo.fault};
}

Status loadLevel(Demo& demo) {
    auto level = readLevel(demo.options.scene.empty() ? kLevel : demo.options.scene);
    if (!level) return level.error();
    for (const std::string& warning : level->warnings)
        spdlog::warn("{}: {}", level->name, warning);
    demo.game = std::make_unique<Game>(std::move(*level), demo.options.serial ? 1 : 0);
    return Ok{};
}

void useQuality(Demo& demo, Quality preset, const render::QualityStep& step) {
    const bool automatic = preset == Quality::kAutomatic;
    const bool small = step.valCount <= render::qualitySteps()[0].valCount;  // with what else low leaves out
    applyQuality(!automatic ? preset : small ? Quality::kLow : Quality::kMedium, demo.gi);
    if (automatic) {
        render::applyQualityStep(step, demo.gi);
        render::addBounces(demo.gi);
        demo.gi.antialiasing.scale = step.scale;
    }
    if (demo.user.resolution > 0) demo.gi.antialiasing.scale = std::clamp(demo.user.resolution, 0.5f, 1.0f);
    demo.gi.composite.exposure = demo.user.exposure + kMood;
    demo.sound.volume = demo.user.volume;
    for (const std::string& assignment : demo.options.assignments)
        if (const Status set = demo.settings.set(assignment); !set) spdlog::warn("{}", set.error().message);
}

render::RenderSettings shownSettings(const Demo& demo) {
    return demo.layer ? render::settingsOf(*demo.layer, demo.gi) : demo.gi;
}

Input nextInput(Demo& demo, uint64_t tick, const Input& given) {
    const Input input = tick < demo.replay.ticks.size() ? demo.replay.ticks[tick]
                        : demo.replay.ticks.empty()     ? given
                                                        : Input{};
    if (!demo.options.record.empty()) demo.recorded.push_back(input);
    return input;
}

Status finishRecording(const Demo& demo) {
    if (demo.options.record.empty()) return Ok{};
    return saveReplay({demo.recorded, replayNotes(demo)}, demo.options.record);
}

}  // namespace ag::game
