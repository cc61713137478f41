// A captured scene for the tests of this folder: recorded once.
#pragma once

#include <gtest/gtest.h>

#include "engine/capture/record.h"
#include "engine/capture/schedule_spans.h"
#include "engine/capture/world_source.h"
#include "engine/scene/static_scene.h"
#include "tests/support/device_environment.h"
#include "tools/scenegen/scenes.h"

namespace ag::capture {

// A few frames of the Cornell box as entities, the camera walking.
inline Capture record(const std::function<void(RecordSettings&)>& change = {}) {
    const SceneAsset asset = *scenegen::buildScene("cornell", 0);
    RecordSettings settings{.size = {96, 64}, .warmUp = 5, .frames = 8};
    settings.gi.bounce.texelRays.enabled = false;  // nothing to see of it while the camera walks
    if (change) change(settings);
    RenderScene scene = staticScene(asset);
    setCamera(scene, cameraOf(asset, 0), settings.size);
    render::Renderer renderer(test::device());
    renderer.load(asset.geometry);
    WorldSource source(asset, scene, settings.size, glm::vec3(0.01f, 0, 0));
    const RenderScene* last = nullptr;
    const auto next = [&](std::vector<Span>& systems) -> const RenderScene& {
        return *(last = &source.next(systems));
    };
    Capture capture{.scene = "cornell", .device = test::device().info().name, .size = settings.size};
    recordFrames(renderer, next, settings, capture);
    describeSchedule(source.schedule(), capture);
    EXPECT_TRUE(recordPictures(renderer, *last, settings, {}, "", capture));
    return capture;
}

inline const Capture& seen() {
    static const Capture kSeen = record();
    return kSeen;
}

}  // namespace ag::capture
