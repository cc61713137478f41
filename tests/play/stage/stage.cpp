#include "tests/play/stage/stage.h"

#include <algorithm>

#include "engine/scene/components.h"
#include "game/dress_level.h"
#include "game/user_files.h"

namespace ag::game {

SceneAsset shippedLevel() {
    return *readLevel(AFTERGLOW_SOURCE_DIR "/game/level/gallery.glb");
}

Stage::Stage(gpu::Device& device, SceneAsset level, uint32_t ticksPerFrame, glm::uvec2 pixels)
    : game(std::move(level), 1), renderer(device), size(pixels), perFrame(ticksPerFrame) {
    applyQuality(Quality::kLow, settings);
    openEyes(settings);
    settings.composite.exposure = UserSettings{}.exposure + kMood;
    options.timing = TimingMode::kOff;
    renderer.load(game.level().geometry);
    std::vector<std::pair<uint32_t, Entity>> found;
    View<const Flower, const LocalTransform>(game.world(), {})
        .each([&](Entity e, const Flower&, const LocalTransform& at) {
            found.push_back({at.node, e});
        });
    std::ranges::sort(found, {}, &std::pair<uint32_t, Entity>::first);
    for (const auto& [node, entity] : found)
        flowers.push_back(entity);
}

void Stage::tick(const Input& input) {
    game.tick(input);
    if (++ticks % perFrame == 0) show();
    watch();
}

Image Stage::picture() {
    return render::readImage(renderer, shown);
}

void Stage::show() {
    game.frame(size);
    renderer.render(game.scene(), size, settings, options,
                    [&](GraphScope scope, const render::SceneView&, const render::RenderFrame& frame) {
                        shown = frame.outputs.display;
                        scope.output(shown);
                    });
    game.takeReadings(renderer.probeReadings());
}

Flower Stage::flower(size_t index) {
    return *game.world().get<Flower>(flowers.at(index));
}

render::ProbeLight Stage::lightAt(size_t index) {
    return *game.world().get<render::ProbeLight>(flowers.at(index));
}

glm::dvec3 Stage::flowerAt(size_t index) {
    return game.world().get<LocalTransform>(flowers.at(index))->translation + glm::dvec3(0, 0.7, 0);
}

}  // namespace ag::game
