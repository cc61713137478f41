// Work against change: what a frame costs when little changes, beside all of its passes.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "engine/core/function_ref.h"
#include "engine/gpu/device.h"
#include "engine/renderer/render_settings.h"
#include "engine/scene/static_scene.h"

namespace ag::bench {

// What happens in every frame measured.
enum class Change : uint32_t {
    kEverything,    // nothing, but no pass is skipped
    kNothing,       //
    kCamera,        // walks slowly
    kCameraByFlux,  // the same; clusters do not depend on the view (importance.view_weight=0)
    kSmallThing,    // slides in the lower right corner of the view
    kUnseenThing,   // slides behind the camera
    kLight,         // the brightest turns or wanders slowly
    kDark,          // the camera walks, all lights are off
    kCount
};
std::string_view changeName(Change change);

struct PassCost {
    double ranIn = 0;  // share of the frames
    double cpuMs = 0;  // process CPU time, mean of all frames
};
struct ChangeCost {
    double gpuMs = 0;                        // a frame, by timestamps, mean
    double cpuMs = 0;                        // process CPU time of a frame's passes, mean
    std::map<std::string, PassCost> passes;  // that ran
};

struct SceneCosts {
    std::string scene;  // its name, for charts and tables
    glm::uvec2 size{0};
    std::array<ChangeCost, size_t(Change::kCount)> changes;
    const ChangeCost& of(Change change) const { return changes[size_t(change)]; }
};

// Adds a small box to asset and scene and measures every change. `scene` is of `asset`. Costs come without a
// name.
SceneCosts measureChanges(gpu::Device& device, SceneAsset& asset, RenderScene scene, glm::uvec2 size,
                          const render::RenderSettings& settings, FunctionRef<void(double)> progress);

std::string changesToSvg(const std::vector<SceneCosts>& scenes, std::string_view device);
std::string changesToMarkdown(const std::vector<SceneCosts>& scenes, std::string_view device);

}  // namespace ag::bench
