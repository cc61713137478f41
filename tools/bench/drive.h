// The longest frame of a drive: a world that moves, seen from a path through its cameras, frame by frame.
// Every frame is waited for, so that what a long one was long from can be named.
#pragma once

#include <string>
#include <vector>

#include "engine/core/function_ref.h"
#include "engine/gpu/device.h"
#include "engine/renderer/render_settings.h"
#include "engine/scene/scene_asset.h"
#include "engine/scene/static_scene.h"

namespace ag::bench {

struct DriveOptions {
    glm::uvec2 size{480, 270};
    uint32_t frames = 2000, warmUp = 48;
    uint32_t rounds = 1;                // over the path
    uint32_t spawned = 0;               // movable things that come, and as many that go, in every frame
    uint32_t threads = 0;               // of the world and of culling; 0: as many as the machine has
    bool standing = false;              // the camera stays at the first stop
    double secondsPerFrame = 1.0 / 30;  // of the world's clock
};

// What a frame took, ms.
struct FrameCost {
    double whole = 0;  // of the wall: from the world's first system to the device's end
    double cpu = 0;    // processor time of the calling thread: all of the host's work with one thread
    double world = 0, extract = 0;  // of that: systems before extraction; extraction
    double render = 0;              // of that: what the renderer takes to declare, record and submit
    double device = 0;              // sum of the passes
    uint64_t uploadedBytes = 0;
    uint32_t waits = 0;  // transfers that were waited for before the frame was submitted
};

// A frame and what of it took longer than it does in the median frame, worst first.
struct Culprit {
    std::string step;   // a pass, or a step on the CPU
    double excess = 0;  // ms over the median of frames in which it ran
    std::string why;    // it ran
};
struct LongFrame {
    uint32_t frame = 0;
    double ms = 0;
    std::vector<Culprit> culprits;
};

struct Spread {
    double median = 0, p99 = 0, worst = 0;
};

struct DriveReport {
    std::string scene, device;
    std::vector<FrameCost> frames;
    std::vector<LongFrame> longest;  // ten, the longest first
    uint32_t framesThatWaited = 0;
    std::vector<double> roundMib;  // in use by the process after each round
    std::vector<uint64_t> roundDeviceBytes;
    uint32_t instances = 0, movers = 0, lights = 0;

    Spread of(double FrameCost::*part) const;
};

// A closed path through the asset's cameras in turn; with one camera it walks to and fro before it.
class DrivePath {
  public:
    explicit DrivePath(const SceneAsset& asset);
    CameraPose at(double share) const;

  private:
    std::vector<CameraPose> stops_;
    double length_ = 0;  // m, of the way before a single camera
};

// `asset` must outlive the call.
DriveReport drive(gpu::Device& device, const SceneAsset& asset, const render::RenderSettings& settings,
                  const DriveOptions& options, FunctionRef<void(double)> progress);

std::string driveToText(const DriveReport& report);
std::string driveToJson(const DriveReport& report);

}  // namespace ag::bench
