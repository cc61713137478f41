// The demo's command line.
#pragma once

#include <optional>
#include <string>

#include "engine/core/settings.h"
#include "engine/frame/frame_graph.h"
#include "engine/renderer/frame_budget.h"
#include "engine/renderer/renderer.h"
#include "engine/scene/extract_system.h"
#include "game/game.h"
#include "game/sounds.h"
#include "game/user_files.h"

namespace ag::game {

struct DemoOptions {
    bool headless = false;
    uint32_t frames = 0;  // 0: until closed; headless: as long as the replay
    uint32_t ticksPerFrame = 1;
    std::string replay, record, scene, screenshot, report, moments, film, view;
    std::optional<uint32_t> filmFrom;  // frame; nothing: the run's middle
    std::string sizeText = "640x360";
    glm::uvec2 size{640, 360};
    std::vector<std::string> assignments;
    std::string quality, userFolder;
    uint32_t captureFrames = 16;  // that F10 records
    bool renderDoc = false;
    double budgetMs = 0;   // of a frame's passes; 0: none was given
    bool resume = false;   // --continue
    uint32_t chapter = 0;  // the room to start in, from 1; 0: where the level starts
    bool serial = false;
    bool validate = false;
    std::vector<std::string> without;  // device features to do without
    std::string fault;                 // of the device, on purpose
};

// What every run of the demo needs: the level, the settings, the device.
struct Demo {
    DemoOptions options;
    std::unique_ptr<Game> game;
    render::RenderSettings gi;
    SoundSettings sound;
    FrameGraphOptions graph;
    Settings settings;
    UserFiles files;
    UserSettings user;
    Bindings keys;
    Replay replay;       // without ticks: none
    std::string device;  // its name, once it is open
    std::vector<Input> recorded;
    gpu::FaultPlan fault;
    std::optional<render::Layer> layer;  // shown instead of the final image
};

// Exit codes: 0 good, 1 a check failed, 2 bad arguments or input, 3 the device failed.
int runHeadless(Demo& demo);
int runWindowed(Demo& demo);
int refuse(const std::string& sentence);

gpu::DeviceOptions deviceOptions(const Demo& demo, std::optional<gpu::WindowSurface> window = {});
// The level anew, from its file.
Status loadLevel(Demo& demo);
// The preset's settings, or the automatic step's, with what the command line set over them.
void useQuality(Demo& demo, Quality preset, const render::QualityStep& step);
// Those of the picture, or of the layer shown in its place.
render::RenderSettings shownSettings(const Demo& demo);
// The tick's input: from the replay while it lasts, else what is given; kept if a recording was asked for.
Input nextInput(Demo& demo, uint64_t tick, const Input& given);
// Saves the recording if one was asked for.
Status finishRecording(const Demo& demo);

}  // namespace ag::game
