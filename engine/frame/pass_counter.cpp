#include "engine/frame/pass_counter.h"

#include <array>
#include <utility>

#include "engine/gpu/context.h"

namespace ag {
namespace {

// In the order of their bits, as the device writes them.
enum Statistic { kVertices, kTriangles, kFragments, kThreads, kStatisticCount };
constexpr VkQueryPipelineStatisticFlags kStatistics =
    VK_QUERY_PIPELINE_STATISTIC_VERTEX_SHADER_INVOCATIONS_BIT |
    VK_QUERY_PIPELINE_STATISTIC_CLIPPING_PRIMITIVES_BIT |
    VK_QUERY_PIPELINE_STATISTIC_FRAGMENT_SHADER_INVOCATIONS_BIT |
    VK_QUERY_PIPELINE_STATISTIC_COMPUTE_SHADER_INVOCATIONS_BIT;

}  // namespace

PassCounter::PassCounter(gpu::Context& context) : context_(context) {
    const VkQueryPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                     .queryType = VK_QUERY_TYPE_PIPELINE_STATISTICS,
                                     .queryCount = kMaxPasses,
                                     .pipelineStatistics = kStatistics};
    AG_VK(context.vk().CreateQueryPool(context.handle(), &info, context.hostAllocation(), &pool_));
    context.setDebugName(VK_OBJECT_TYPE_QUERY_POOL, pool_, "pass_counter");
}

PassCounter::~PassCounter() {
    context_.vk().DestroyQueryPool(context_.handle(), pool_, context_.hostAllocation());
}

void PassCounter::beginFrame(VkCommandBuffer commands) {
    context_.vk().CmdResetQueryPool(commands, pool_, 0, kMaxPasses);
    names_.clear();
}

void PassCounter::begin(VkCommandBuffer commands, std::string_view name) {
    open_ = names_.size() < kMaxPasses;
    if (!open_) return;
    context_.vk().CmdBeginQuery(commands, pool_, uint32_t(names_.size()), 0);
    names_.push_back(name);
}

void PassCounter::end(VkCommandBuffer commands) {
    if (std::exchange(open_, false)) context_.vk().CmdEndQuery(commands, pool_, uint32_t(names_.size()) - 1);
}

std::vector<PassCount> PassCounter::read() const {
    if (names_.empty()) return {};
    std::vector<std::array<uint64_t, kStatisticCount>> counts(names_.size());
    AG_VK(context_.vk().GetQueryPoolResults(context_.handle(), pool_, 0, uint32_t(counts.size()),
                                            counts.size() * sizeof counts[0], counts.data(), sizeof counts[0],
                                            VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT));
    std::vector<PassCount> passes;
    for (size_t i = 0; i < counts.size(); ++i)
        passes.push_back({.name = names_[i],
                          .vertices = counts[i][kVertices],
                          .fragments = counts[i][kFragments],
                          .threads = counts[i][kThreads],
                          .triangles = counts[i][kTriangles]});
    return passes;
}

}  // namespace ag
