// What goes wrong with devices: how it ends, and how to make it happen on purpose.
#pragma once

#include "engine/gpu/functions.h"

#include <atomic>
#include <string>

#include "engine/core/result.h"

namespace ag::gpu {

enum class Fault : uint32_t { kNone, kAllocation, kSubmit, kOutOfDate, kSurfaceLost };

// A fault at its n-th occasion, for tests: "allocation:7", "submit:30", "out_of_date:5", "surface_lost:5".
struct FaultPlan {
    Fault kind = Fault::kNone;
    uint64_t occasion = 0;
};
Result<FaultPlan> parseFaultPlan(const std::string& text);

// Counts occasions; true at the planned one.
class FaultCounter {
  public:
    explicit FaultCounter(FaultPlan plan = {}) : plan_(plan) {}
    bool strikes(Fault kind) { return kind == plan_.kind && ++seen_ == plan_.occasion; }

  private:
    FaultPlan plan_;
    std::atomic<uint64_t> seen_{0};
};

// Fails (failure.h) with one sentence that names the call: nobody near a Vulkan call can go on without it.
void checkVk(VkResult result, const char* call);
#define AG_VK(call) ::ag::gpu::checkVk((call), #call)

}  // namespace ag::gpu
