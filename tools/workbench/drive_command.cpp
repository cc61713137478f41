#include <iostream>

#include "tools/bench/drive.h"
#include "tools/workbench/commands.h"
#include "tools/workbench/progress_line.h"
#include "tools/workbench/render_setup.h"
#include "tools/workbench/scene_options.h"
#include "tools/workbench/text_file.h"

namespace ag::workbench {
namespace {

struct DriveArguments {
    SceneOptions scene{.size = "480x270"};
    bench::DriveOptions drive;
    std::string preset = "afterglow", json;
    std::vector<std::string> set;
};

int runDrive(DriveArguments& o) {
    RenderSetup setup;
    if (const Status good = setup.apply(o.preset, o.set); !good) return refuse(good.error().message);
    if (const Status ready = prepareTextFiles({o.json}); !ready) return refuse(ready.error().message);
    const auto loaded = loadScene(o.scene);
    if (!loaded) return refuse(loaded.error().message);
    auto device = gpu::Device::create({});
    if (!device) return refuse(device.error().message);
    o.drive.size = loaded->size;
    ProgressLine line(o.scene.scene + ": ");
    const bench::DriveReport report =
        bench::drive(**device, *loaded->asset, setup.gi, o.drive, [&](double share) { line(share); });
    std::cout << report.device << '\n' << bench::driveToText(report);
    if (const Status written = writeTextFile(o.json, o.json.empty() ? "" : bench::driveToJson(report));
        !written)
        return refuse(written.error().message);
    return 0;
}

}  // namespace

void addDriveCommand(CLI::App& program, int& exitCode) {
    const auto o = std::make_shared<DriveArguments>();
    CLI::App* command =
        program.add_subcommand("drive", "the longest frames of a drive through a world that moves, and why");
    addSceneOptions(*command, o->scene);
    command->add_option("--frames", o->drive.frames, "in all")
        ->check(CLI::Range(1u, 1000000u))
        ->capture_default_str();
    command->add_option("--warm-up", o->drive.warmUp, "frames before that")->capture_default_str();
    command->add_option("--rounds", o->drive.rounds, "over the path through the scene's cameras")
        ->check(CLI::Range(1u, 1000u))
        ->capture_default_str();
    command->add_option("--spawn", o->drive.spawned, "movable things that come and go in every frame")
        ->check(CLI::Range(0u, 100000u));
    command->add_option("--threads", o->drive.threads, "0: as many as the machine has")
        ->check(CLI::Range(0u, 256u));
    command->add_flag("--standing", o->drive.standing, "the camera stays at its first stop");
    command->add_option("--preset", o->preset, "as render's")->capture_default_str();
    command->add_option("--set", o->set, "group.name=value, repeatable");
    command->add_option("--json", o->json, "FILE.json");
    command->callback([o, &exitCode] { exitCode = runDrive(*o); });
}

}  // namespace ag::workbench
