// GPU time of passes by timestamps, read a few frames later without stalling. A full barrier stands on both
// sides of each timestamp: CPU devices otherwise run a pass before the timestamp that should precede it is
// taken.
#pragma once

#include <volk.h>

#include <array>
#include <cstdint>
#include <vector>

namespace ag {

namespace gpu {
class Device;
}

class FrameTimer {
  public:
    explicit FrameTimer(gpu::Device& device);
    ~FrameTimer();
    FrameTimer(const FrameTimer&) = delete;
    FrameTimer& operator=(const FrameTimer&) = delete;

    // Reads the results of the frame that used this slot before: calls back with (tag, ms) for each pass. Its
    // work must have finished.
    template <class F>
    void beginFrame(VkCommandBuffer commands, F&& result) {
        Ring& ring = rings_[next_];
        if (readBack(ring))
            for (size_t i = 0; i < ring.tags.size(); ++i)
                result(ring.tags[i], double(values_[2 * i + 1] - values_[2 * i]) * 1e-6 * periodNs_);
        restart(commands, ring);
    }
    void begin(VkCommandBuffer commands, uint32_t tag);
    void end(VkCommandBuffer commands);

  private:
    static constexpr uint32_t kMaxPasses = 256;
    struct Ring {
        VkQueryPool pool = VK_NULL_HANDLE;
        std::vector<uint32_t> tags;
    };
    bool readBack(Ring& ring);
    void restart(VkCommandBuffer commands, Ring& ring);
    void stamp(VkCommandBuffer commands, uint32_t query);

    gpu::Device& device_;
    double periodNs_;
    std::array<Ring, 3> rings_;
    size_t next_ = 0, active_ = 0;
    bool open_ = false;  // a begin() waits for its end()
    std::vector<uint64_t> values_;
};

}  // namespace ag
