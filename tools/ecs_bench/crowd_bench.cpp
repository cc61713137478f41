// 100,000 moving objects of the scene `crowd`: moved, placed, extracted with bounds, culled by the camera and
// copied for upload, by the engine's own systems.
#include <cstring>

#include "engine/ecs/schedule.h"
#include "engine/scene/extract_system.h"
#include "engine/scene/mover.h"
#include "engine/scene/spawn_scene.h"
#include "engine/scene/transform_system.h"
#include "tools/ecs_bench/rows.h"
#include "tools/scenegen/scenes.h"

namespace ag::ecs_bench {
namespace {

constexpr uint32_t kCrowd = 100'000;

struct Seconds {
    double now = 0;
};
struct Visible {
    std::vector<uint64_t> rows;  // a bit each
};
struct Staging {
    std::vector<RenderInstance> rows;
    uint64_t copied = 0;
};

void moveCrowd(View<LocalTransform, const Mover> movers, Res<const Seconds> time, JobRunner& runner) {
    moveAlong(movers, time->now, runner);
}
void cullCamera(Res<const RenderScene> scene, Res<const ExtractState> state, Res<Visible> visible,
                JobRunner& runner) {
    state->bounds.cull(viewPlanes(scene->camera.clipFromWorld), visible->rows, runner);
}
void copyChanged(Res<const RenderScene> scene, Res<Staging> staging, JobRunner& runner) {
    constexpr uint32_t kPiece = 4096;  // rows
    staging->rows.resize(scene->instances.size());
    const auto copy = [&](uint32_t begin, uint32_t end) {
        std::memcpy(static_cast<void*>(&staging->rows[begin]), &scene->instances[begin],
                    (end - begin) * sizeof(RenderInstance));
    };
    const RenderScene::Range all{0, uint32_t(scene->instances.size())};
    const std::span<const RenderScene::Range> ranges =
        scene->allInstancesChanged ? std::span(&all, 1) : std::span(scene->changedInstances);
    for (const RenderScene::Range& range : ranges) {
        staging->copied += range.end - range.begin;
        runner.parallelFor(range.end - range.begin, kPiece, [&](uint32_t begin, uint32_t end) {
            copy(range.begin + begin, range.begin + end);
        });
    }
}

struct Crowd {
    SceneAsset asset = scenegen::buildScene("crowd", kCrowd).value();
    World world;
    Schedule schedule;
    JobRunner runner;

    explicit Crowd(uint32_t threads) : runner(threads) {
        spawnScene(world, asset);
        world.setResource<Seconds>();
        world.setResource<Visible>();
        world.setResource<Staging>();
        world.setResource<ExtractState>();
        world.setResource<ActiveCamera>(cameraOf(asset, 0));
        world.setResource<RenderScene>().geometry = &asset.geometry;
        schedule.add("moveCrowd", moveCrowd);
        schedule.add("updateRootTransforms", updateRootTransforms);
        schedule.add("updateChildTransforms", updateChildTransforms);
        schedule.add("extractScene", extractScene);
        schedule.add("cullCamera", cullCamera);
        schedule.add("copyChanged", copyChanged);
        for (int i = 0; i < 5; ++i)
            frame();
    }
    void frame() {
        world.resource<Seconds>().now += 1.0 / 60;
        schedule.run(world, runner);
    }
};

Bench crowdFrame(uint32_t threads, Clock clock) {
    return [=, crowd = std::shared_ptr<Crowd>()](benchmark::State& state) mutable {
        if (!crowd) crowd = std::make_shared<Crowd>(threads);
        const uint64_t before = crowd->world.resource<Staging>().copied;
        timed(
            state, 1, [&] { crowd->frame(); }, clock);
        state.counters["copied"] =
            double(crowd->world.resource<Staging>().copied - before) / double(state.iterations());
    };
}

}  // namespace

void addCrowdRows(Rows& rows) {
    rows.alone("crowd: 100k move, place, bounds, cull, copy, 1 thread", 0, crowdFrame(1, Clock::kWall), 0.2);
    rows.alone("crowd, two threads", 8e6, crowdFrame(2, Clock::kWall), 0.5);
    rows.against("crowd, two threads to one", 1 / 1.7, "crowd, two threads/ours",
                 "crowd: 100k move, place, bounds, cull, copy, 1 thread/ours");
}

}  // namespace ag::ecs_bench
