// One scene for the renderer and the reference.
#pragma once

#include <gtest/gtest.h>

#include "engine/core/image_difference.h"
#include "engine/renderer/renderer.h"
#include "engine/scene/static_scene.h"
#include "tests/support/device_environment.h"
#include "tools/reference/reference.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
using namespace render;

struct Parity {
    explicit Parity(const char* name, uint32_t param = 0, glm::uvec2 pixels = {112, 63})
        : Parity(*scenegen::buildScene(name, param), pixels) {}
    explicit Parity(SceneAsset built, glm::uvec2 pixels = {112, 63})
        : size(pixels), asset(std::move(built)), scene(staticScene(asset)), renderer(test::device()) {
        setCamera(scene, cameraOf(asset, 0), size);
        renderer.load(asset.geometry);
    }
    Image render(Layer layer, const RenderSettings& settings, uint32_t frames) {
        return renderLayer(renderer, scene, size, settings, layer, frames);
    }
    reference::Reference trace(const reference::ReferenceSettings& settings) {
        const reference::RayScene rays(scene);
        JobRunner runner(2);
        const auto silent = [](double) {};
        return reference::makeReference(rays, size, settings, runner, silent);
    }

    glm::uvec2 size;
    SceneAsset asset;
    RenderScene scene;
    Renderer renderer;
};

inline ImageDifference differ(const Image& truth, const Image& test) {
    const auto d = compareImages(truth, test);
    EXPECT_TRUE(d);
    return d ? *d : ImageDifference{};
}

}  // namespace ag::gi
