// Specialization constants go by their names and types.
#include <gtest/gtest.h>

#include "engine/core/failure.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/pipeline.h"
#include "tests/support/device_environment.h"

namespace ag {
namespace {

// Of a shader with `const bool kSquare`; why it could not be made, or nothing.
std::string madeWith(const gpu::SpecConstant& constant) {
    gpu::PipelineRequest request{
        .computeShader = "denoiser/filter.comp", .spec = {constant}, .specCount = 1, .neededCount = 1};
    onFailure([](FailureKind kind, const std::string& sentence) { throw Failure(kind, sentence); });
    std::string why;
    try {
        EXPECT_NE(test::device().pipelines().get(request).handle, VK_NULL_HANDLE);
    } catch (const Failure& failure) {
        why = failure.what();
    }
    onFailure(nullptr);
    return why;
}

TEST(Pipeline, ConstantsHaveTheShadersNamesAndTypes) {
    EXPECT_EQ(madeWith(gpu::specConstant("kSquare", true)), "");
    EXPECT_NE(madeWith(gpu::specConstant("kRound", true)).find("has no constant kRound"), std::string::npos);
    EXPECT_NE(madeWith(gpu::specConstant("kSquare", 1.0f)).find("of that type"), std::string::npos);
    EXPECT_NE(madeWith(gpu::specConstant("kSquare", 1u)).find("of that type"), std::string::npos);
}

// A dispatch that the device cannot take would be dropped without a word.
TEST(Pipeline, DispatchesBeyondTheDevicesLimitAreSaid) {
    const uint32_t most = test::device().info().limits.maxComputeWorkGroupCount[1];
    if (most == UINT32_MAX) GTEST_SKIP() << "the device takes any";
    FrameGraph graph(&test::device().context(), &test::device().pipelines());
    graph.beginFrame({.timing = TimingMode::kOff});
    const BufferHandle from = graph.buffer("from", {.sizeBytes = 256}),
                       to = graph.buffer("to", {.sizeBytes = 256});
    graph.fill("count.zero", from, 0);
    graph.compute("count.step", "test/add_step.comp")
        .read("previous", from)
        .write("current", to)
        .dispatchGroups(1, most + 1);
    graph.output(to);
    onFailure([](FailureKind kind, const std::string& sentence) { throw Failure(kind, sentence); });
    std::string why;
    try {
        test::device().runOnce([&](VkCommandBuffer commands) { graph.execute(commands); });
    } catch (const Failure& failure) {
        why = failure.what();
    }
    onFailure(nullptr);
    EXPECT_NE(why.find("count.step"), std::string::npos) << why;
    EXPECT_NE(why.find("maxComputeWorkGroupCount"), std::string::npos) << why;
}

}  // namespace
}  // namespace ag
