// A scene in a window: a free camera, every layer, its lights and settings to edit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/app/free_camera.h"
#include "engine/core/settings.h"
#include "engine/gpu/device.h"
#include "engine/renderer/renderer.h"
#include "engine/scene/asset_edits.h"

namespace ag::viewer {

struct ViewerOptions {
    std::string title;
    glm::uvec2 size{640, 360};  // pixels, of the window
    uint32_t frames = 0;        // leaves after so many; 0: when it is closed
    std::string screenshot;     // PNG of the last frame
    std::vector<Input> script;  // played in place of keys and mouse, one a frame of 1/60 s
    std::string record;         // keeps what was pressed as such a script
    // Path tracing from the start; on leaving, after so many paths a pixel, its halves and our radiance are
    // saved as STEM_1.exr, STEM_2.exr and STEM_ours.exr, and the error is printed. Empty: not.
    std::string truthStem;
    uint32_t truthSamples = 64;
    bool validate = false;
};

// What is shown; the viewer edits all of it.
struct Viewing {
    RenderScene& scene;
    SceneAsset& asset;  // of the scene; its materials change with `edits`
    AssetEdits edits;   // from how it was loaded, with what a session had changed
    CameraPose pose;
    render::RenderSettings& gi;
    Settings& settings;
    FrameGraphOptions& graph;
    std::string preset;
    bool lightsEdited = false, skyEdited = false;
};

// Each returns the file that was written.
using SaveViewing = FunctionRef<Result<std::string>(const Viewing&)>;

// Until it is closed. Sessions are saved on F5, the edited scene as glTF on F6. Returns 0, 1 after a
// validation message, 2 after a sentence on stderr.
int runViewer(Viewing& viewing, const ViewerOptions& options, SaveViewing session, SaveViewing scene);

}  // namespace ag::viewer
