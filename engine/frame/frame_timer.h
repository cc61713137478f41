// GPU time of passes by timestamps, read a few frames later without stalling. A pass begins where the one
// before it in its command buffer ended, so that its own barriers count as its own. Bracketed, a full barrier
// stands on both sides of each timestamp and the time is the pass's alone; else passes that overlap share it.
// The device copies the timestamps to where the host reads them: asking it for query results waits on
// lavapipe for all its work.
#pragma once

#include "engine/gpu/functions.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace ag {

constexpr uint32_t kTimerFrames = 3;  // so many later the times of a frame are read

namespace gpu {
class Buffer;
class Context;
}  // namespace gpu

class FrameTimer {
  public:
    static constexpr uint32_t kMaxPasses = 1024;

    explicit FrameTimer(gpu::Context& context);
    ~FrameTimer();
    FrameTimer(const FrameTimer&) = delete;
    FrameTimer& operator=(const FrameTimer&) = delete;

    // Reads the results of the frame that used this slot before: calls back with (tag, first tick, last tick)
    // for each pass, and returns that frame's number, 0 if there is none. Its work must have finished.
    template <class F>
    uint64_t beginFrame(VkCommandBuffer commands, uint64_t frame, bool bracketed, F&& result) {
        bracketed_ = bracketed;
        Ring& ring = rings_[next_];
        const std::span<const uint64_t> ticks = ticksOf(ring);
        const uint64_t read = ticks.empty() ? 0 : ring.frame;
        for (const Timed& pass : ring.passes)
            result(pass.tag, ticks[pass.begin], ticks[pass.end]);
        restart(commands, ring);
        ring.frame = frame;
        return read;
    }
    double milliseconds(uint64_t ticks) const { return double(ticks) * 1e-6 * periodNs_; }
    void begin(VkCommandBuffer commands, uint32_t tag);
    void end(VkCommandBuffer commands);
    void endFrame(VkCommandBuffer commands);  // after the last pass of all queues

  private:
    struct Timed {
        uint32_t tag = 0, begin = 0, end = 0;  // the last two of the ring's ticks
    };
    struct Ring {
        VkQueryPool pool = VK_NULL_HANDLE;
        std::unique_ptr<gpu::Buffer> ticks;
        std::vector<Timed> passes;
        uint32_t ticksUsed = 0;
        uint64_t frame = 0;
    };
    static std::span<const uint64_t> ticksOf(const Ring& ring);
    void restart(VkCommandBuffer commands, Ring& ring);
    uint32_t stamp(VkCommandBuffer commands);

    gpu::Context& context_;
    double periodNs_;
    std::array<Ring, kTimerFrames> rings_;
    size_t next_ = 0, active_ = 0;
    bool bracketed_ = false;
    bool open_ = false;                      // a begin() waits for its end()
    VkCommandBuffer last_ = VK_NULL_HANDLE;  // what the last pass was in
};

}  // namespace ag
