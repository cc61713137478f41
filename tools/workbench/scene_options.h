// What every sub-command that takes a SCENE understands: the scene, its camera, lights added or dropped.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/number_option.h"
#include "engine/core/result.h"
#include "engine/scene/asset_edits.h"
#include "engine/scene/static_scene.h"

namespace ag::workbench {

constexpr double kMostNumber = 1e12;  // m or W/sr: beyond it, products of floats are not finite

struct PlacedLight {
    RenderLight light;
    glm::dvec3 position{0};  // m, in the world
};

struct SceneOptions {
    std::string scene;
    uint32_t param = 0;
    std::string camera;  // index or name
    std::string clip;    // INDEX,SECONDS
    std::string size = "640x360";
    std::string view;                 // PX,PY,PZ,TX,TY,TZ[,VFOV_DEG]
    std::vector<std::string> suns;    // DX,DY,DZ[,E]
    std::vector<std::string> points;  // X,Y,Z,I
    std::vector<std::string> spots;   // X,Y,Z,DX,DY,DZ,I,INNER_DEG,OUTER_DEG
    std::string sky;                  // COLOUR, FILE or DX,DY,DZ[,TURBIDITY]
    uint32_t hungLamps = 0;           // points of light in free space
    bool noSceneLights = false;
    // Of a session: the scene's own lights as they were edited, and where it was seen from.
    std::optional<std::vector<PlacedLight>> lights;
    std::optional<CameraPose> pose;
    AssetEdits edits;  // of a session
};

void addSceneOptions(CLI::App& command, SceneOptions& options);

struct LoadedScene {
    std::unique_ptr<SceneAsset> asset;  // stays in place: the scene points into it
    RenderScene scene;
    glm::uvec2 size{0};
    bool lightAdded = false;  // there was none
    std::string skyAdded;     // as --sky takes it; empty: none was
};

// A name from the library of scenes becomes its file, with its view and sun where none are given.
Result<SceneOptions> withLibraryScene(SceneOptions options);

// What is added to a scene without any light.
enum class MissingLight { kSun, kSunAndSky };

// Everything the options say, ready to render; warnings are logged.
Result<LoadedScene> loadScene(const SceneOptions& options, MissingLight missing = MissingLight::kSun);

// "0.1,0,0" in m; nothing for an empty text
Result<glm::vec3> parseStep(const std::string& text);

}  // namespace ag::workbench
