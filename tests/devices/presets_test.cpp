// Every preset draws on this device what it draws on the default one, as near as the default device comes to
// itself with other clusters. With AFTERGLOW_DEVICES_DRAW this is the default device: its pictures are kept
// in AFTERGLOW_DEVICES_FOLDER.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>

#include "engine/core/image.h"
#include "engine/core/safe_file.h"
#include "engine/renderer/renderer.h"
#include "engine/scene/static_scene.h"
#include "tests/support/device_environment.h"
#include "tools/scenegen/scenes.h"

namespace ag {
namespace {

constexpr const char* kScenes[] = {"cornell", "corridor"};
constexpr glm::uvec2 kSize{160, 90};
constexpr uint32_t kFrames = 4;
// Where nothing is clustered: edges of triangles and of shadows fall otherwise on another rasteriser.
constexpr double kLeastSpread = 0.005;

// All passes of the preset, with less of each: a device without a cache of shaders has a minute.
render::RenderSettings settingsOf(std::string_view preset, uint32_t moreClusters = 0) {
    render::RenderSettings s;
    EXPECT_TRUE(render::applyPreset(preset, s));
    s.bounce.rsm.resolution = 128;
    s.bounce.valClustering.count = 48 + moreClusters;
    s.bounce.ismAtlas.pointsPerMap = std::min(s.bounce.ismAtlas.pointsPerMap, 512u);
    s.bounce.ismAtlas.tileSize = std::min(s.bounce.ismAtlas.tileSize, 32u);
    return s;
}

std::string folder() {
    const char* given = std::getenv("AFTERGLOW_DEVICES_FOLDER");
    return given ? std::string(given) + "/" : "";
}

struct Stage {
    explicit Stage(const char* name)
        : asset(*scenegen::buildScene(name, 0)), scene(staticScene(asset)), renderer(test::device()) {
        setCamera(scene, cameraOf(asset, 0), kSize);
    }
    Image draw(const render::RenderSettings& settings) {
        renderer.load(asset.geometry);  // without histories
        return render::renderLayer(renderer, scene, kSize, settings, render::Layer::kRadiance, kFrames,
                                   {.timing = TimingMode::kOff});
    }
    SceneAsset asset;
    RenderScene scene;
    render::Renderer renderer;
};

double difference(const Image& a, const Image& b) {
    const auto d = compareImages(a, b);
    EXPECT_TRUE(d) << d.error().message;
    return d ? d->relativeRmse : 1e9;
}

// The pictures, and how far other clusters lead.
void drawAll() {
    ASSERT_TRUE(makeFolderOf(folder() + "spreads.txt"));
    std::ofstream spreads(folder() + "spreads.txt");
    for (const char* name : kScenes) {
        Stage stage(name);
        for (const std::string_view preset : render::presetNames()) {
            const Image image = stage.draw(settingsOf(preset));
            ASSERT_TRUE(saveImage(image, folder() + name + "_" + std::string(preset) + ".pfm"));
            double spread = kLeastSpread;
            for (const uint32_t more : {4u, 8u})
                spread = std::max(spread, difference(image, stage.draw(settingsOf(preset, more))));
            spreads << name << ' ' << preset << ' ' << spread << '\n';
        }
    }
    ASSERT_TRUE(spreads.good());
}

void compareAll() {
    std::ifstream spreads(folder() + "spreads.txt");
    ASSERT_TRUE(spreads.good()) << "devices.default has not run";
    std::map<std::string, Stage> stages;
    std::string name, preset;
    double spread = 0;
    int compared = 0;
    for (; spreads >> name >> preset >> spread; ++compared) {
        const auto truth = loadImage(folder() + name + "_" + preset + ".pfm");
        ASSERT_TRUE(truth) << truth.error().message;
        Stage& stage = stages.try_emplace(name, name.c_str()).first->second;
        const double off = difference(*truth, stage.draw(settingsOf(preset)));
        std::printf("%-9s %-18s relative RMSE %.4f, other clusters %.4f\n", name.c_str(), preset.c_str(), off,
                    spread);
        EXPECT_LE(off, spread) << name << ' ' << preset;
    }
    EXPECT_EQ(size_t(compared), std::size(kScenes) * render::presetNames().size());
}

TEST(Devices, PresetsDrawWhatTheDefaultDeviceDraws) {
    if (folder().empty()) GTEST_SKIP() << "AFTERGLOW_DEVICES_FOLDER is not set";
    std::printf("%s\n", test::device().info().name.c_str());
    if (std::getenv("AFTERGLOW_DEVICES_DRAW"))
        drawAll();
    else
        compareAll();
}

}  // namespace
}  // namespace ag
