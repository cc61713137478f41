#include "tools/bench/drive.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <numbers>

#include "common/sampling.h"
#include "engine/core/process_memory.h"
#include "engine/ecs/schedule.h"
#include "engine/renderer/renderer.h"
#include "engine/scene/animation_system.h"
#include "engine/scene/extract_system.h"
#include "engine/scene/mover.h"
#include "engine/scene/spawn_scene.h"
#include "engine/scene/transform_system.h"
#include "tools/bench/long_frames.h"

namespace ag::bench {
namespace {

using Clock = std::chrono::steady_clock;

double msSince(Clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

// Of the calling thread.
double processorMs() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) * 1e3 + double(t.tv_nsec) * 1e-6;
}

struct DriveTime {  // resource
    double seconds = 0;
};

void moveThings(View<LocalTransform, const Mover> movers, Res<const DriveTime> time, JobRunner& runner) {
    moveAlong(movers, time->seconds, runner);
}

// A curve through four values, at a share of the way from the second to the third (Catmull and Rom 1974).
template <class V>
V between(const V& a, const V& b, const V& c, const V& d, double t) {
    return 0.5 * (2.0 * b + (c - a) * t + (2.0 * a - 5.0 * b + 4.0 * c - d) * (t * t) +
                  (3.0 * (b - c) + d - a) * (t * t * t));
}

// Things that come and go: copies of what moves, near where that does. Each stays one to eight frames, so
// that how many there are changes from frame to frame.
class Spawner {
  public:
    Spawner(World& world, uint32_t perFrame) : world_(world), perFrame_(perFrame) {
        View<const MeshInstance, const Mover, Without<SkinnedMesh>>(world, {}).each(
            [&](const MeshInstance& mesh, const Mover& mover) {
                models_.push_back({mesh, mover});
            });
    }
    void step() {
        if (perFrame_ == 0 || models_.empty()) return;
        std::vector<Entity>& leaving = leaving_[frame_++ % leaving_.size()];
        world_.destroy(leaving);
        leaving.clear();
        for (uint32_t i = 0; i < perFrame_; ++i)
            spawn(next_++);
    }

  private:
    void spawn(uint32_t number) {
        auto [mesh, moves] = models_[io::hashUint(number) % models_.size()];
        moves.origin +=
            glm::dvec3(io::hashToUnit(2 * number) - 0.5f, 0, io::hashToUnit(2 * number + 1) - 0.5f);
        const size_t stays = io::hashUint(~number) % leaving_.size();
        leaving_[(frame_ + stays) % leaving_.size()].push_back(
            world_.create(LocalTransform{.translation = moves.origin}, WorldTransform{}, mesh, moves));
    }

    World& world_;
    uint32_t perFrame_, next_ = 0, frame_ = 0;
    std::vector<std::pair<MeshInstance, Mover>> models_;
    std::array<std::vector<Entity>, 8> leaving_;  // by the frame's number
};

class Drive {
  public:
    Drive(gpu::Device& device, const SceneAsset& asset, const render::RenderSettings& settings,
          const DriveOptions& o)
        : device_(device),
          path_(asset),
          settings_(settings),
          o_(o),
          jobs_(o.threads),
          renderer_(device, o.threads) {
        spawnScene(world_, asset);
        world_.setResource<DriveTime>();
        world_.setResource<ExtractState>();
        world_.setResource<ActiveCamera>(path_.at(0), o.size);
        RenderScene& scene = world_.setResource<RenderScene>();
        scene.geometry = &asset.geometry;
        scene.sky = asset.sky;
        before_.add("moveThings", moveThings);
        before_.add("playAnimations",
                    [step = float(o.secondsPerFrame)](
                        View<AnimationPlayer> players, Res<const SkinnedMeshLibrary> library,
                        JobRunner& runner) { advancePlayers(players, *library, step, runner); });
        before_.add("animateNodes", animateNodes);
        before_.add("updateRootTransforms", updateRootTransforms);
        before_.add("updateChildTransforms", updateChildTransforms);
        before_.add("poseSkinnedMeshes", poseSkinnedMeshes);
        extract_.add("extractScene", extractScene);
        spawner_.emplace(world_, o.spawned);
        renderer_.load(asset.geometry);
    }

    void frame(double share, FrameCost& cost, LongFrames& steps) {
        const uint64_t waitsBefore = device_.transfersWaitedFor();
        const auto begin = Clock::now();
        const double started = processorMs();
        spawner_->step();
        world_.resource<DriveTime>().seconds += o_.secondsPerFrame;
        world_.resource<ActiveCamera>().pose = path_.at(o_.standing ? 0 : share);
        before_.run(world_, jobs_);
        const double moved = processorMs();
        extract_.run(world_, jobs_);
        const double extracted = processorMs();
        renderer_.render(world_.resource<RenderScene>(), o_.size, settings_, {},
                         [](GraphScope scope, const render::SceneView&, const render::RenderFrame& declared) {
                             scope.output(declared.outputs.display);
                         });
        cost.waits = uint32_t(device_.transfersWaitedFor() - waitsBefore);
        device_.waitFor(device_.submittedValue());
        cost.whole = msSince(begin);
        const double done = processorMs();
        cost.world = moved - started;
        cost.extract = extracted - moved;
        cost.render = done - extracted;
        cost.cpu = done - started;
        cost.uploadedBytes = renderer_.scene().uploadedBytes();
        steps.note(cost);
        steps.note(renderer_.graph());
    }
    const RenderScene& scene() const { return world_.resource<RenderScene>(); }
    uint64_t deviceBytes() const { return renderer_.deviceBytes(); }
    uint32_t movers() { return View<const Mover, const MeshInstance>(world_, {}).count(); }

  private:
    gpu::Device& device_;
    const DrivePath path_;
    const render::RenderSettings& settings_;
    const DriveOptions& o_;
    World world_;
    Schedule before_, extract_;
    JobRunner jobs_;
    std::optional<Spawner> spawner_;
    render::Renderer renderer_;
};

}  // namespace

DrivePath::DrivePath(const SceneAsset& asset) {
    for (size_t i = 0; i < std::max<size_t>(asset.cameras.size(), 1); ++i)
        stops_.push_back(cameraOf(asset, i));
    if (stops_.size() > 1) return;
    const RenderScene scene = staticScene(asset, stops_[0].position);
    length_ = double(glm::length(scene.bounds.max - scene.bounds.min)) / 20;
}

CameraPose DrivePath::at(double share) const {
    const size_t stops = stops_.size();
    CameraPose pose = stops_[0];
    if (stops == 1) {
        pose.position +=
            glm::dvec3(pose.forward) * (0.5 * length_ * (1 - std::cos(2 * std::numbers::pi * share)));
        return pose;
    }
    const double way = (share - std::floor(share)) * double(stops), t = way - std::floor(way);
    const auto stop = [&](size_t i) -> const CameraPose& {
        return stops_[(size_t(way) + stops - 1 + i) % stops];
    };
    const auto turned = [&](glm::vec3 CameraPose::*look) {
        return glm::vec3(glm::normalize(between(glm::dvec3(stop(0).*look), glm::dvec3(stop(1).*look),
                                                glm::dvec3(stop(2).*look), glm::dvec3(stop(3).*look), t)));
    };
    pose = stop(1);
    pose.position = between(stop(0).position, stop(1).position, stop(2).position, stop(3).position, t);
    pose.forward = turned(&CameraPose::forward);
    pose.up = turned(&CameraPose::up);
    return pose;
}

DriveReport drive(gpu::Device& device, const SceneAsset& asset, const render::RenderSettings& settings,
                  const DriveOptions& options, FunctionRef<void(double)> progress) {
    DriveReport report{.scene = asset.name, .device = device.info().name};
    Drive drive(device, asset, settings, options);
    LongFrames unused, steps;
    FrameCost ignored;
    for (uint32_t i = 0; i < options.warmUp; ++i)
        drive.frame(0, ignored, unused);
    report.instances = uint32_t(drive.scene().instances.size());
    report.lights = uint32_t(drive.scene().lights.size());
    report.movers = drive.movers();
    const uint32_t perRound = std::max(options.frames / std::max(options.rounds, 1u), 1u);
    for (uint32_t i = 0; i < options.frames; ++i) {
        drive.frame(double(i) / perRound, report.frames.emplace_back(), steps);
        report.framesThatWaited += report.frames.back().waits > 0;
        progress(double(i + 1) / options.frames);
        if ((i + 1) % perRound != 0) continue;
        report.roundMib.push_back(residentMib());
        report.roundDeviceBytes.push_back(drive.deviceBytes());
    }
    steps.finish(report);
    return report;
}

}  // namespace ag::bench
