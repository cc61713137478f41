// What the device counts while it runs passes (pipeline statistics). Frames that count are not timed: some
// drivers fail when one command buffer holds several kinds of queries.
#pragma once

#include "engine/gpu/functions.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace ag {

namespace gpu {
class Context;
}

struct PassCount {
    std::string_view name;
    uint64_t vertices = 0, fragments = 0, threads = 0;  // shader invocations
    uint64_t triangles = 0;                             // left by clipping

    uint64_t invocations() const { return vertices + fragments + threads; }
};

class PassCounter {
  public:
    static constexpr uint32_t kMaxPasses = 1024;

    explicit PassCounter(gpu::Context& context);  // whose DeviceInfo::counts is true
    ~PassCounter();
    PassCounter(const PassCounter&) = delete;
    PassCounter& operator=(const PassCounter&) = delete;

    void beginFrame(VkCommandBuffer commands);
    void begin(VkCommandBuffer commands, std::string_view name);  // outside of rendering
    void end(VkCommandBuffer commands);
    // Of the frame begun last. Waits for its work, which must have been submitted.
    std::vector<PassCount> read() const;

  private:
    gpu::Context& context_;
    VkQueryPool pool_ = VK_NULL_HANDLE;
    std::vector<std::string_view> names_;
    bool open_ = false;  // a begin() waits for its end()
};

}  // namespace ag
