// The path tracer's picture of what the viewer shows, made beside it and better from second to second.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "engine/core/image_difference.h"
#include "engine/scene/render_scene.h"
#include "tools/reference/pixel_filter.h"

namespace ag::viewer {

// Radiance in W/(m² sr) with every light, gloss and 16 bounces.
struct TruthPicture {
    uint64_t subject = 0;  // of LiveTruth::follow: what it is a picture of
    Image halves[2];       // independent of each other
    Image mean;
    uint32_t samples = 0;  // paths a pixel, of both halves
    double seconds = 0;    // since the subject changed
    double noise = 0;      // relative RMSE of the mean, from the halves
};

// Numbers of `ours` against it, its noise taken out; fails where sizes differ or a value is not finite.
Result<ImageDifference> compareWithTruth(const TruthPicture& truth, const Image& ours);

class LiveTruth {
  public:
    // `threads` 0: half of the machine's.
    explicit LiveTruth(uint32_t threads = 0, uint32_t mostSamples = 4096);
    ~LiveTruth();
    LiveTruth(const LiveTruth&) = delete;
    LiveTruth& operator=(const LiveTruth&) = delete;

    // What is to be traced; begins anew where camera, lights, sky, size or filter differ. The scene's
    // geometry must stay until this ends, the scene itself is copied. `filter`: as the renderer's picture has
    // it.
    void follow(const RenderScene& scene, glm::uvec2 size,
                reference::PixelFilter filter = reference::PixelFilter::kCenter);
    uint64_t subject() const { return wantedSubject_; }
    // Null: none of the subject yet.
    std::shared_ptr<const TruthPicture> newest() const;

  private:
    struct Work;
    void run();
    bool waitForWork(Work& work);
    void trace(Work& work);
    bool superseded(uint64_t subject) const;

    const uint32_t threads_, mostSamples_;
    uint64_t wantedSubject_ = 0;  // of the caller's thread; the rest is shared
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    RenderScene wanted_;
    glm::uvec2 size_{0};
    reference::PixelFilter filter_ = reference::PixelFilter::kCenter;
    uint64_t subject_ = 0;
    bool leave_ = false;
    std::shared_ptr<const TruthPicture> newest_;
    std::thread thread_;
};

}  // namespace ag::viewer
