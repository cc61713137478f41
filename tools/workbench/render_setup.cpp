#include "tools/workbench/render_setup.h"
#include "engine/core/near_name.h"

namespace ag::workbench {

RenderSetup::RenderSetup() {
    registry.add({"engine", "skip", 0, 0, "", "leave out passes whose inputs did not change"}, &graph.skip);
    registry.add({"engine", "alias", 0, 0, "", "scratch images share memory"}, &graph.alias);
    render::registerSettings(registry, gi);
}

Status RenderSetup::apply(const std::string& preset, const std::vector<std::string>& assignments) {
    if (!render::applyPreset(preset, gi)) return Error{missingName("preset", preset, render::presetNames())};
    for (const std::string& assignment : assignments)
        if (Status set = registry.set(assignment); !set) return set;
    return Ok{};
}

}  // namespace ag::workbench
