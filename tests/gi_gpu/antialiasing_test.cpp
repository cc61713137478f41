// Anti-aliasing against the picture sampled 8 x 8 times a pixel and filtered on the CPU.
#include <gtest/gtest.h>

#include <numeric>

#include "antialiasing/antialiasing_io.h"
#include "tests/gi_gpu/bench.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
using namespace render;
namespace {

constexpr glm::uvec2 kSize{96, 64};
constexpr uint32_t kSamples = 8;  // along each side of a pixel

struct Direct : Bench {
    explicit Direct(glm::uvec2 pixels = kSize, Antialiasing mode = Antialiasing::kTemporal)
        : Bench(*scenegen::buildScene("cornell", 0), pixels) {
        settings.technique = Technique::kNone;
        settings.antialiasing.mode = mode;
    }
    void frames(int count) {
        for (int i = 0; i < count; ++i)
            frame();
    }
    Image radiance() { return readImage(renderer, last.outputs.radiance); }
    Image display() { return readImage(renderer, last.outputs.display); }
    void step(glm::vec3 by) {
        scene.instances[kBox].worldFromLocal[3] += by;
        scene.changedInstances = {{kBox, kBox + 1}};
        scene.allInstancesChanged = false;
        ++scene.instancesVersion;
    }
    void look(float right) {
        CameraPose pose = cameraOf(asset, 0);
        pose.position.x += double(right);
        setCamera(scene, pose, size);
    }
    static constexpr uint32_t kBox = 1;
};

Image filtered(const Image& fine) {
    Image out(int(kSize.x), int(kSize.y));
    const int reach = int(std::ceil(io::kFilterRadius * kSamples));
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x) {
            glm::dvec3 sum(0);
            double weights = 0;
            const int cx = x * int(kSamples) + int(kSamples) / 2, cy = y * int(kSamples) + int(kSamples) / 2;
            for (int v = std::max(cy - reach, 0); v < std::min(cy + reach, fine.height); ++v)
                for (int u = std::max(cx - reach, 0); u < std::min(cx + reach, fine.width); ++u) {
                    const double weight = double(io::filterWeight((float(u - cx) + 0.5f) / kSamples) *
                                                 io::filterWeight((float(v - cy) + 0.5f) / kSamples));
                    sum += weight * glm::dvec3(fine.pixels[size_t(v) * size_t(fine.width) + size_t(u)]);
                    weights += weight;
                }
            out.pixels[size_t(y) * kSize.x + size_t(x)] = glm::vec3(sum / weights);
        }
    return out;
}

// `prepare` moves what is to be seen.
Image truthOf(const std::function<void(Direct&)>& prepare = [](Direct&) {}) {
    Direct fine(kSize * kSamples, Antialiasing::kOff);
    prepare(fine);
    fine.frame();
    return filtered(fine.radiance());
}

// Where the truth's neighbours differ by a fifth of its mean and more.
std::vector<size_t> edgesOf(const Image& truth) {
    const float least = 0.2f * float(meanOf(truth));
    std::vector<size_t> edges;
    for (int y = 1; y + 1 < truth.height; ++y)
        for (int x = 1; x + 1 < truth.width; ++x) {
            const size_t at = size_t(y) * size_t(truth.width) + size_t(x);
            float low = 1e30f, high = 0;
            for (const size_t other : {at - 1, at + 1, at - size_t(truth.width), at + size_t(truth.width)}) {
                low = std::min(low, luminanceOf(truth.pixels[other]));
                high = std::max(high, luminanceOf(truth.pixels[other]));
            }
            if (high - low > least) edges.push_back(at);
        }
    return edges;
}

double rmseAt(const std::vector<size_t>& pixels, const Image& image, const Image& truth) {
    double sum = 0;
    for (const size_t i : pixels) {
        const glm::dvec3 d = image.pixels[i] - truth.pixels[i];
        sum += glm::dot(d, d) / 3;
    }
    return std::sqrt(sum / double(pixels.size()));
}

double aliasedRmse(
    const std::vector<size_t>& pixels, const Image& truth,
    const std::function<void(Direct&)>& prepare = [](Direct&) {}) {
    Direct aliased(kSize, Antialiasing::kOff);
    prepare(aliased);
    aliased.frame();
    return rmseAt(pixels, aliased.radiance(), truth);
}

TEST(Antialiasing, FilterWeighsASampleAPixelAsOne) {
    for (const float offset : {-0.5f, -0.2f, 0.0f, 0.31f, 0.5f}) {
        float sum = 0;
        for (int i = -3; i <= 3; ++i)
            sum += io::filterWeight(float(i) + offset);
        EXPECT_NEAR(sum, 1, 0.04) << offset;
    }
}

TEST(Antialiasing, AStillPictureConvergesToTheFilteredOne) {
    const Image truth = truthOf();
    const std::vector<size_t> edges = edgesOf(truth);
    ASSERT_GT(edges.size(), 200u);
    const double aliased = aliasedRmse(edges, truth);
    Direct b;
    b.frames(1);
    const double first = rmseAt(edges, b.radiance(), truth);
    b.frames(20);
    const double still = rmseAt(edges, b.radiance(), truth);
    std::printf("%zu pixels at edges, RMSE %.4f aliased, %.4f after one frame, %.4f at rest\n", edges.size(),
                aliased, first, still);
    EXPECT_LT(first, aliased);
    EXPECT_LT(still, aliased / 3);
    EXPECT_NEAR(meanOf(b.radiance()) / meanOf(truth), 1, 0.003);
}

TEST(Antialiasing, HalfTheSizeConvergesToTheSamePicture) {
    const Image truth = truthOf();
    const std::vector<size_t> edges = edgesOf(truth);
    const double aliased = aliasedRmse(edges, truth);
    Direct b;
    b.settings.antialiasing.scale = 0.5f;
    b.frames(80);
    EXPECT_EQ(b.passesRun(), 0);
    EXPECT_EQ(b.renderer.graph().info(b.last.gbuffer.surfaces.depth).size, kSize / 2u);
    const Image image = b.radiance();
    ASSERT_EQ(image.width, int(kSize.x));
    const double still = rmseAt(edges, image, truth);
    std::printf("RMSE at edges %.4f aliased, %.4f of a quarter of the pixels at rest\n", aliased, still);
    EXPECT_LT(still, aliased / 3);
}

TEST(Antialiasing, RestsWhenNothingChanges) {
    Direct b;
    b.frames(17);
    EXPECT_GT(b.passesRun(), 0);
    b.frames(3);
    const Image before = b.radiance();
    EXPECT_EQ(b.passesRun(), 0);
    b.frames(5);
    EXPECT_EQ(b.radiance().pixels, before.pixels);
}

TEST(Antialiasing, SkippingChangesNoBit) {
    std::vector<glm::vec3> pixels[2];
    for (const bool skip : {true, false}) {
        Direct b;
        b.options.skip = skip;
        for (int i = 0; i < 60; ++i) {
            b.scene.changedInstances.clear();
            if (i >= 25 && i < 30) b.step({0.02f, 0, 0});
            b.frame();
        }
        pixels[skip] = b.radiance().pixels;
    }
    EXPECT_EQ(pixels[0], pixels[1]);
}

TEST(Antialiasing, AWalkingCameraSeesNoMoreThanABlur) {
    constexpr int kSteps = 12;
    constexpr float kStep = 0.013f;  // m: about a pixel
    const auto walked = [](Direct& b) { b.look(kSteps * kStep); };
    const Image truth = truthOf(walked);
    const std::vector<size_t> edges = edgesOf(truth);
    const double aliased = aliasedRmse(edges, truth, walked);
    Direct b;
    b.frames(20);
    for (int i = 1; i <= kSteps; ++i) {
        b.look(float(i) * kStep);
        b.frame();
    }
    const double walking = rmseAt(edges, b.radiance(), truth);
    b.frames(20);
    const double still = rmseAt(edges, b.radiance(), truth);
    std::printf("RMSE at edges %.4f aliased, %.4f walking, %.4f after\n", aliased, walking, still);
    EXPECT_LT(walking, 0.75 * aliased);
    EXPECT_LT(still, aliased / 3);
}

// While the camera stands, the picture does not lose its smooth edges to what moves, nor keep a trace of it.
TEST(Antialiasing, WhatMovesLeavesNoTraceAndOtherEdgesSmooth) {
    constexpr int kSteps = 10;
    const glm::vec3 step(0.03f, 0, 0.01f);
    const auto moved = [&](Direct& b) { b.step(float(kSteps) * step); };
    const Image truth = truthOf(moved);
    const std::vector<size_t> edges = edgesOf(truth);
    const double aliased = aliasedRmse(edges, truth, moved);
    Direct b;
    b.frames(25);
    for (int i = 0; i < kSteps; ++i) {
        b.step(step);
        b.frame();
    }
    const double moving = rmseAt(edges, b.radiance(), truth);
    b.scene.changedInstances.clear();
    b.frames(25);
    EXPECT_EQ(b.passesRun(), 0);
    const double still = rmseAt(edges, b.radiance(), truth);
    std::printf("RMSE at edges %.4f aliased, %.4f moving, %.4f after\n", aliased, moving, still);
    EXPECT_LT(moving, 0.6 * aliased);
    EXPECT_LT(still, aliased / 2.5);
}

// However long something else moves: all that stays the same stays so bit for bit.
TEST(Antialiasing, WhatStaysTheSameDoesNotDrift) {
    Direct b;
    b.frames(25);
    const Image before = b.radiance();
    const auto move = [&](int frames) {
        for (int i = 0; i < frames; ++i) {
            b.step(glm::vec3(0));  // told to have moved
            b.frame();
        }
        return b.radiance();
    };
    const Image soon = move(60), late = move(100);
    size_t same = 0;
    float most = 0;
    for (size_t i = 0; i < before.pixels.size(); ++i) {
        same += before.pixels[i] == late.pixels[i];
        most = std::max(most, std::abs(luminanceOf(late.pixels[i] - soon.pixels[i])));
    }
    std::printf("%.1f %% of the pixels are the same, none is off by more than %.5f\n",
                100 * double(same) / double(before.pixels.size()), most);
    EXPECT_GT(double(same), 0.8 * double(before.pixels.size())) << "all but the box and what is about it";
    EXPECT_LT(most, 0.01 * meanOf(before));
}

TEST(Antialiasing, LightThatChangesIsFollowed) {
    Direct b;
    b.frames(25);
    Image wanted = b.radiance();
    for (glm::vec3& p : wanted.pixels)
        p *= 0.25f;
    std::vector<size_t> all(wanted.pixels.size());
    std::iota(all.begin(), all.end(), size_t(0));
    for (RenderLight& light : b.scene.lights)
        light.intensity *= 0.25f;
    ++b.scene.lightsVersion;
    b.frame();
    const double atOnce = rmseAt(all, b.radiance(), wanted);
    b.frames(24);
    EXPECT_EQ(b.passesRun(), 0);
    const double after = rmseAt(all, b.radiance(), wanted);
    std::printf("RMSE of the mean: %.4f at once, %.4f after\n", atOnce / meanOf(wanted),
                after / meanOf(wanted));
    EXPECT_LT(after, 0.05 * atOnce);
}

TEST(Antialiasing, SpatialSmoothsTheEdgesOfOneFrame) {
    Direct fine(kSize * kSamples, Antialiasing::kOff);
    fine.frame();
    const Image truth = filtered(fine.display());
    const std::vector<size_t> edges = edgesOf(truth);
    Direct aliased(kSize, Antialiasing::kOff), smooth(kSize, Antialiasing::kSpatial);
    aliased.frame();
    smooth.frame();
    const double without = rmseAt(edges, aliased.display(), truth),
                 with = rmseAt(edges, smooth.display(), truth);
    std::printf("RMSE of display values at edges %.4f without, %.4f with\n", without, with);
    EXPECT_LT(with, 0.8 * without);
    smooth.frames(3);
    EXPECT_EQ(smooth.passesRun(), 0);
}

TEST(Antialiasing, OffMakesNoPass) {
    Direct b(kSize, Antialiasing::kOff);
    b.frame();
    EXPECT_EQ(b.outcome("antialiasing.resolve"), PassOutcome::kDropped);
    EXPECT_EQ(b.outcome("antialiasing.smooth_edges"), PassOutcome::kDropped);
}

}  // namespace
}  // namespace ag::gi
