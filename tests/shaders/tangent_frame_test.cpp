// Frames of normal maps: texture's u to the right, its top at y.
#include <gtest/gtest.h>

#include "common/tangent_frame.h"

namespace ag::io {
namespace {

const vec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

void expectFrame(const TangentFrame& f, vec3 t, vec3 b) {
    EXPECT_LT(glm::distance(f.t, t), 1e-6f);
    EXPECT_LT(glm::distance(f.b, b), 1e-6f);
    EXPECT_EQ(f.n, kZ);
}

// A picture hung upright: v grows downward.
TEST(TangentFrame, OfStepsInWhateverDirections) {
    const auto uvOf = [](vec3 p) { return vec2(2 * p.x, -3 * p.y); };
    for (const auto& [px, py] :
         {std::pair(kX, kY), std::pair(kX, -kY), std::pair(-kX, kY), std::pair(kY, kX),
          std::pair(1e-8f * kX + 1e-8f * kY, 1e-8f * kX - 2e-8f * kY), std::pair(40.0f * kY, kX - kY)})
        expectFrame(frameOfSteps(kZ, px, py, uvOf(px), uvOf(py)), kX, kY);
}

TEST(TangentFrame, OfMirroredCoordinatesHasItsTopWhereThePictureHas) {
    expectFrame(frameOfSteps(kZ, kX, kY, vec2(-1, 0), vec2(0, -1)), -kX, kY);
    expectFrame(frameOfSteps(kZ, kX, kY, vec2(1, 0), vec2(0, 1)), kX, -kY);
}

// As a file says it: the same frames by handedness.
TEST(TangentFrame, OfTangents) {
    expectFrame(frameOfTangent(kZ, vec4(1, 0, 0.3f, 1)), kX, kY);
    expectFrame(frameOfTangent(kZ, vec4(-2, 0, 0, -1)), -kX, kY);
}

TEST(TangentFrame, WithoutCoordinatesLeavesTheNormal) {
    const TangentFrame f = frameOfSteps(kZ, kX, kY, vec2(0), vec2(0));
    EXPECT_EQ(fromFrame(f, vec3(0.3f, 0.2f, 0.5f)), 0.5f * kZ);
}

}  // namespace
}  // namespace ag::io
