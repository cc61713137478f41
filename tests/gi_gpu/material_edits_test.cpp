// Materials that change after they were loaded: what follows is what a renderer that loaded them so shows.
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/core/image_difference.h"
#include "engine/renderer/renderer.h"
#include "engine/scene/asset_edits.h"
#include "engine/scene/static_scene.h"
#include "tests/gi_gpu/bench.h"
#include "tools/scenegen/scenes.h"

namespace ag {
namespace {

constexpr glm::uvec2 kSize{48, 36};
constexpr uint32_t kFrames = 64;  // what settles has

Image seen(render::Renderer& renderer, const RenderScene& scene) {
    render::RenderSettings settings;
    render::addBounces(settings);
    gi::useSmallMaps(settings);
    settings.bounce.texelRays.enabled = false;  // they go on for longer
    return render::renderLayer(renderer, scene, kSize, settings, render::Layer::kRadiance, kFrames);
}

double rmse(const Image& a, const Image& b) {
    return compareImages(a, b)->relativeRmse;
}

TEST(MaterialEdits, AreSeenAsIfTheyHadBeenLoaded) {
    SceneAsset asset = *scenegen::buildScene("cornell", 0);
    RenderScene scene = staticScene(asset);
    setCamera(scene, cameraOf(asset, 0), kSize);
    render::Renderer renderer(test::device());
    renderer.load(asset.geometry);
    const Image before = seen(renderer, scene);

    MaterialLook look = lookOf(asset.geometry, 0);
    look.baseColor = {0.1f, 0.2f, 0.9f, 1};
    look.emissive = {0.5f, 0.1f, 0};
    setLook(look, asset.geometry.materials[0]);
    ++asset.geometry.version;
    renderer.loadMaterials(asset.geometry);
    const Image edited = seen(renderer, scene);
    EXPECT_GT(rmse(before, edited), 0.1) << "it shows";

    render::Renderer fresh(test::device());
    fresh.load(asset.geometry);
    EXPECT_LT(rmse(seen(fresh, scene), edited), 0.05) << "as far as other clusters are";
}

bool mirrors(render::Renderer& renderer) {
    const auto report = renderer.graph().report();
    return std::ranges::any_of(report,
                               [](const PassReport& p) { return p.name.ends_with("reflections.march"); });
}

TEST(MaterialEdits, WhatIsPolishedReflects) {
    SceneAsset asset = *scenegen::buildScene("cornell", 0);
    RenderScene scene = staticScene(asset);
    setCamera(scene, cameraOf(asset, 0), kSize);
    render::Renderer renderer(test::device());
    renderer.load(asset.geometry);
    seen(renderer, scene);
    EXPECT_FALSE(mirrors(renderer));
    asset.geometry.materials[0].metallic = 1;
    asset.geometry.materials[0].roughness = 0.05f;
    ++asset.geometry.version;
    renderer.loadMaterials(asset.geometry);
    seen(renderer, scene);
    EXPECT_TRUE(mirrors(renderer));
}

}  // namespace
}  // namespace ag
