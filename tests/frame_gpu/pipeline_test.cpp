// Specialization constants go by their names and types.
#include <gtest/gtest.h>

#include "engine/core/failure.h"
#include "engine/gpu/pipeline.h"
#include "engine/gpu/shader_files.h"
#include "tests/support/device_environment.h"

namespace ag {
namespace {

// Of a shader with `const bool kSquare`; why it could not be made, or nothing.
std::string madeWith(const gpu::SpecConstant& constant) {
    gpu::PipelineLibrary pipelines(test::device(), gpu::loadShader);
    gpu::PipelineRequest request{
        .computeShader = "denoiser/filter.comp", .spec = {constant}, .specCount = 1, .neededCount = 1};
    onFailure([](FailureKind kind, const std::string& sentence) { throw Failure(kind, sentence); });
    std::string why;
    try {
        EXPECT_NE(pipelines.get(request).handle, VK_NULL_HANDLE);
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

}  // namespace
}  // namespace ag
