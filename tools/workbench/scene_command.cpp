#include <fmt/format.h>

#include <iostream>

#include "engine/core/number_option.h"
#include "engine/core/safe_file.h"
#include "engine/scene/gltf_export.h"
#include "tools/scenegen/scenes.h"
#include "tools/workbench/commands.h"

namespace ag::workbench {
namespace {

int runScene(const std::string& name, uint32_t param, const std::string& output) {
    auto asset = scenegen::buildScene(name, param);
    if (!asset) return refuse(asset.error().message);
    if (const Status writable = checkWritable(output); !writable) return refuse(writable.error().message);
    if (const Status saved = exportGlb(*asset, output); !saved) return refuse(saved.error().message);
    std::cout << fmt::format("{}: {} nodes, {} triangles\n", output, asset->nodes.size(),
                             triangleCount(*asset));
    return 0;
}

}  // namespace

void addSceneCommand(CLI::App& program, int& exitCode) {
    struct Options {
        std::string name, output;
        uint32_t param = 0;
    };
    const auto o = std::make_shared<Options>();
    CLI::App* command = program.add_subcommand("scene", "write a built-in scene as a GLB file");
    command->add_option("name", o->name, "built-in scene")->required();
    command->add_option("-o,--output", o->output, "FILE.glb")->required();
    command->add_option("--param", o->param, "the scene's number, where it takes one");
    command->callback([o, &exitCode] { exitCode = runScene(o->name, o->param, o->output); });
}

}  // namespace ag::workbench
