// Every pass that the GI frame can declare is in the table of a capture that has it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <regex>
#include <set>

#include "engine/capture/pass_table.h"
#include "engine/capture/record.h"
#include "engine/core/safe_file.h"
#include "engine/scene/static_scene.h"
#include "tests/support/device_environment.h"
#include "tools/scenegen/scenes.h"

namespace ag::capture {
namespace {

// From the sources of light and renderer: the names given where a pass is added. Views for debugging are no
// part of the frame.
std::set<std::string> passesOfTheSource() {
    static const std::regex kAdded(
        R"re((?:compute|fullscreen|raster|fill|upload|copyImage)\(\s*"(\w+\.\w+)")re");
    std::set<std::string> names;
    for (const char* folder : {"/gi", "/gi/published", "/engine/renderer"})
        for (const auto& file :
             std::filesystem::directory_iterator(std::string(AFTERGLOW_SOURCE_DIR) + folder)) {
            if (file.path().extension() != ".cpp" || file.path().stem() == "debug_view") continue;
            const std::string text = *readFile(file.path());
            for (std::sregex_iterator i(text.begin(), text.end(), kAdded), end; i != end; ++i)
                names.insert((*i)[1]);
        }
    return names;
}

constexpr std::array<std::string_view, 4> kSamePasses = {"low", "medium", "high", "ultra"};  // as afterglow

struct Case {
    std::string_view preset;
    const char* scene;
    uint32_t param = 0;
    bool options = false;  // those that no preset turns on
    bool waits = false;    // what may be late is, from the second frame after the warm-up
    bool rests = false;    // nothing moves
};

void moveLast(RenderScene& scene) {
    const uint32_t last = uint32_t(scene.instances.size()) - 1;
    scene.instances[last].worldFromLocal[3].x += 0.01f;
    if (!scene.skinnedMeshes.empty()) ++scene.skinnedMeshes.back().poseVersion;
    scene.changedInstances = {{last, last + 1}};
    scene.allInstancesChanged = scene.instancesVersion == 1;
    ++scene.instancesVersion;
}

void addPasses(const Case& c, std::set<std::string>& names) {
    SceneAsset asset = *scenegen::buildScene(c.scene, c.param);
    asset.geometry.materials[0].alphaMode = AlphaMode::kMask;
    asset.geometry.materials[0].specular = 1;
    if (c.options) asset.geometry.materials[0].roughness = 0.1f;
    RecordSettings settings{.size = {64, 48}, .warmUp = 1, .frames = 1};
    ASSERT_TRUE(render::applyPreset(c.preset, settings.gi));
    settings.gi.bounce.laterBounces.enabled = c.options;
    settings.gi.bounce.texelRays.enabled = c.options || c.rests || c.waits;
    settings.gi.exposure.automatic = c.options;
    settings.gi.bloom.share = c.options ? 0.1f : 0.0f;
    settings.gi.antialiasing.mode =
        c.options ? render::Antialiasing::kTemporal : render::Antialiasing::kSpatial;
    settings.gi.bounce.denoiser.enabled = settings.gi.bounce.denoiser.motion = true;
    settings.gi.bounce.stochasticRsm.interpolate = c.preset == "rsm-400";
    settings.gi.bounce.valClustering.count = 64;
    settings.gi.bounce.rsm.resolution = 128;
    if (c.rests) {
        settings.warmUp = 3;  // trees and what was asked for are as in the frame before
        // The first pixels' turn is over in these frames.
        settings.gi.bounce.texelRays.settleFrames = settings.gi.bounce.valClustering.settleFrames = 2;
        settings.frames = 4;
        settings.gi.bounce.denoiser.enabled = false;  // pixels of all turns are joined
    }
    if (c.waits) {
        settings.gi.bounce.valClustering.settleFrames = 0;
        settings.gi.bounce.refresh.small = 1;
        settings.frames = 3;
    }
    RenderScene scene = staticScene(asset);
    setCamera(scene, cameraOf(asset, 0), settings.size);
    scene.instances.back().movable = true;
    scene.lights.push_back(
        {.kind = LightKind::kDirectional, .direction = {0, -1, 0}, .reflects = c.options, .id = 1000});
    if (c.options) scene.sky = std::make_shared<const Sky>(constantSky(glm::vec3(1)));
    scene.probes = {{.position = scene.camera.position, .id = 1}};
    render::Renderer renderer(test::device());
    renderer.load(asset.geometry);
    Capture capture;
    const auto next = [&](std::vector<Span>&) -> const RenderScene& {
        if (!c.rests) moveLast(scene);
        return scene;
    };
    recordFrames(renderer, next, settings, capture);
    for (const PassRow& row : makeTable(capture))
        names.insert(row.name.substr(row.name.rfind('/') + 1));  // whatever scope it is in
}

TEST(PassTable, HasEveryPassThatTheFrameCanHave) {
    const std::set<std::string> wanted = passesOfTheSource();
    ASSERT_GT(wanted.size(), 40u) << "the source is read as it is written";
    std::set<std::string> captured;
    addPasses({"afterglow", "cornell", 0, true}, captured);
    addPasses({.preset = "afterglow", .scene = "cornell", .waits = true}, captured);
    addPasses({.preset = "afterglow", .scene = "cornell", .rests = true}, captured);
    addPasses({"afterglow", "lamps", 20}, captured);
    addPasses({"afterglow", "figures", 1}, captured);
    addPasses({"afterglow", "panes"}, captured);
    for (const std::string_view preset : render::presetNames())
        if (std::ranges::count(kSamePasses, preset) == 0) addPasses({preset, "cornell"}, captured);
    for (const std::string& name : wanted)
        EXPECT_TRUE(captured.contains(name)) << name;
}

}  // namespace
}  // namespace ag::capture
