#include "common/sampling.h"
#include "engine/core/image_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "engine/core/safe_file.h"
#include "tests/support/own_folder.h"

namespace ag {
namespace {

namespace fs = std::filesystem;

Image ramp(int width, int height) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.at(x, y) = {float(x) * 0.25f, float(y) * 3.0f, 1e-3f * float(x * y)};
    return image;
}

TEST(ImageFiles, FloatsSurviveExactly) {
    const Image image = ramp(17, 9);
    for (const char* name : {"ramp.pfm", "ramp.exr"}) {
        ASSERT_TRUE(saveImage(image, test::ownFile(name)));
        const auto back = loadImage(test::ownFile(name));
        ASSERT_TRUE(back) << back.error().message;
        ASSERT_EQ(back->width, 17);
        ASSERT_EQ(back->height, 9);
        EXPECT_EQ(back->pixels, image.pixels) << name;
    }
}

TEST(ImageFiles, ExrKeepsAttributes) {
    Image image = ramp(5, 4);
    image.attributes = {{"noise", "0.0123"}, {"scene", "cornell"}};
    ASSERT_TRUE(saveImage(image, test::ownFile("attributes.exr")));
    const auto back = loadImage(test::ownFile("attributes.exr"));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->attributes, image.attributes);
}

TEST(ImageFiles, RefuseWithASentenceAndLeaveNothing) {
    const Status lost = saveImage(ramp(2, 2), "/nonexistent/folder/a.pfm");
    ASSERT_FALSE(lost);
    EXPECT_NE(lost.error().message.find("/nonexistent/folder/a.pfm"), std::string::npos);
    EXPECT_FALSE(saveImage(ramp(2, 2), test::ownFile("a.gif")));
    EXPECT_FALSE(fs::exists(test::ownFile("a.gif")));
    EXPECT_FALSE(loadImage(test::ownFile("missing.exr")));
    std::ofstream(test::ownFile("short.pfm"), std::ios::binary) << "PF\n100 100\n-1.0\nxx";
    EXPECT_FALSE(loadImage(test::ownFile("short.pfm")));
    std::ofstream(test::ownFile("text.exr")) << "not an image";
    EXPECT_FALSE(loadImage(test::ownFile("text.exr")));
}

TEST(ImageFiles, DamagedExrsAreRefusedInOneLine) {
    ASSERT_TRUE(saveImage(ramp(9, 7), test::ownFile("whole.exr")));
    const std::string whole = *readFile(test::ownFile("whole.exr"));
    std::mt19937 random(5);
    int refused = 0;
    for (int i = 0; i < 300; ++i) {
        std::string damaged = whole;
        for (int n = 0; n < 1 + i % 7; ++n)
            damaged[random() % std::min<size_t>(whole.size(), 350)] = char(random());
        ASSERT_TRUE(writeFileSafely(test::ownFile("damaged.exr"), damaged));
        const auto image = loadImage(test::ownFile("damaged.exr"));
        if (image) continue;
        ++refused;
        EXPECT_EQ(image.error().message.find('\n'), std::string::npos) << image.error().message;
    }
    EXPECT_GT(refused, 100);
}

// The decoder makes room for as many chunks as an attribute says there are.
TEST(ImageFiles, AnExrOfMoreChunksThanLinesIsRefused) {
    ASSERT_TRUE(saveImage(ramp(9, 7), test::ownFile("whole.exr")));
    std::string bytes = *readFile(test::ownFile("whole.exr"));
    const auto withChunks = [&](int32_t count) {
        std::string attribute = std::string("chunkCount\0int\0\4\0\0\0", 19);
        attribute.append(reinterpret_cast<const char*>(&count), sizeof count);
        return bytes.substr(0, 8) + attribute + bytes.substr(8);
    };
    for (const int32_t count : {-1, 8, 0x7fffffff}) {
        ASSERT_TRUE(writeFileSafely(test::ownFile("chunks.exr"), withChunks(count)));
        const auto image = loadImage(test::ownFile("chunks.exr"));
        ASSERT_FALSE(image);
        EXPECT_NE(image.error().message.find("more chunks than lines"), std::string::npos)
            << image.error().message;
    }
}

TEST(ImageMetrics, KnownDifferences) {
    Image truth(10, 10), test(10, 10);
    for (auto& p : truth.pixels)
        p = glm::vec3(2);
    for (auto& p : test.pixels)
        p = glm::vec3(2.2f);
    const auto d = compareImages(truth, test);
    ASSERT_TRUE(d);
    EXPECT_NEAR(d->meanRatio, 1.1, 1e-6);
    EXPECT_NEAR(d->rmse, 0.2, 1e-6);
    EXPECT_NEAR(d->relativeRmse, 0.1, 1e-6);
    EXPECT_NEAR(d->p99, 0.2 / 2.02, 1e-5);
}

Image filled(int width, int height, float value) {
    Image image(width, height);
    for (glm::vec3& p : image.pixels)
        p = glm::vec3(value);
    return image;
}

// With noise of mean 0 and that deviation, even over twice its root of three.
Image withNoise(Image image, float deviation, uint32_t seed) {
    const float width = 2 * std::sqrt(3.0f) * deviation;
    uint32_t place = seed * 7919u << 20;
    for (glm::vec3& p : image.pixels)
        for (int c = 0; c < 3; ++c)
            p[c] += width * (io::hashToUnit(++place) - 0.5f);
    return image;
}

TEST(ImageMetrics, ToneSquashesWhatIsBright) {
    const auto d = compareImages(filled(10, 10, 1), filled(10, 10, 3));
    ASSERT_TRUE(d);
    EXPECT_NEAR(d->toneRmse, 0.75 - 0.5, 1e-6);
    Image spike = filled(10, 10, 1);
    spike.pixels[42] = glm::vec3(1e6f);
    const auto one = compareImages(filled(10, 10, 1), spike);
    ASSERT_TRUE(one);
    EXPECT_NEAR(one->toneRmse, 0.05, 1e-4) << "a hundredth of the pixels off by a half";
    const auto black = compareImages(Image(4, 4), Image(4, 4));
    ASSERT_TRUE(black);
    EXPECT_EQ(black->toneRmse, 0);
}

TEST(ImageMetrics, TrimmingDropsTheWorstHundredth) {
    Image test = filled(20, 20, 2.2f);
    for (const size_t worst : {7, 133, 260, 399})
        test.pixels[worst] = glm::vec3(50);
    const auto d = compareImages(filled(20, 20, 2), test);
    ASSERT_TRUE(d);
    EXPECT_NEAR(d->trimmedRelativeRmse, 0.1, 1e-6);
    EXPECT_NEAR(d->relativeRmse, std::sqrt((396 * 0.04 + 4 * 48.0 * 48.0) / 400) / 2, 1e-5);
    test.pixels[8] = glm::vec3(50);
    const auto fifth = compareImages(filled(20, 20, 2), test);
    EXPECT_NEAR(fifth->trimmedRelativeRmse, std::sqrt((395 * 0.04 + 48.0 * 48.0) / 396) / 2, 1e-5)
        << "one more than a hundredth stays";
}

TEST(ImageMetrics, MedianIsOfMostPixels) {
    Image test = filled(10, 10, 2.1f);
    for (size_t i = 0; i < 40; ++i)
        test.pixels[i] = glm::vec3(9);
    const auto d = compareImages(filled(10, 10, 2), test);
    ASSERT_TRUE(d);
    EXPECT_NEAR(d->medianRelative, 0.1 / 2.02, 1e-6);
}

TEST(ImageMetrics, LeaksAreBrightWhereTheTruthIsNot) {
    // Four kinds of pixels, 25 each; the truth's mean is 1.
    const float truths[] = {0.5f, 0.5f, 2.5f, 0.5f}, tests[] = {5.5f, 4.5f, 20, 0.5f};
    Image truth(10, 10), test(10, 10);
    for (size_t i = 0; i < 100; ++i)
        truth.pixels[i] = glm::vec3(truths[i / 25]), test.pixels[i] = glm::vec3(tests[i / 25]);
    const auto d = compareImages(truth, test);
    ASSERT_TRUE(d);
    EXPECT_EQ(d->leakPixels, 25) << "not those below 5 means, nor those where the truth is bright";
}

TEST(ImageMetrics, TwoTruthsCancelTheirNoise) {
    const Image truth = filled(200, 200, 2), test = filled(200, 200, 2.2f);
    const Image a = withNoise(truth, 0.5f, 1), b = withNoise(truth, 0.5f, 2);
    const auto one = compareImages(a, test), two = compareImages({a, b}, test);
    ASSERT_TRUE(one && two);
    EXPECT_NEAR(one->rmse, std::sqrt(0.04 + 0.25), 0.01) << "with the noise in it";
    EXPECT_NEAR(two->rmse, 0.2, 0.01);
    EXPECT_NEAR(two->relativeRmse, 0.1, 0.005);
    // t(x) = x / (x + 2), to second order in the noise
    EXPECT_NEAR(two->toneRmse, 2.2 / 4.2 - 0.5 + 0.25 / 32, 0.002);
    const auto little = compareImages({withNoise(truth, 0.1f, 1), withNoise(truth, 0.1f, 2)}, test);
    EXPECT_NEAR(little->medianRelative, 0.2 / 2.02, 0.01);
    EXPECT_GT(two->medianRelative, 0.6 * 0.2 / 2.02);
    EXPECT_LT(two->medianRelative, 0.2 / 2.02);
    const auto none = compareImages({a, b}, truth);
    EXPECT_LT(none->rmse, 0.06);
    EXPECT_LT(none->medianRelative, 0.04);
    EXPECT_GT(compareImages(a, truth)->medianRelative, 0.2);
}

TEST(ImageMetrics, TwoTestsCancelTheirs) {
    const Image truth = filled(200, 200, 2), right = filled(200, 200, 2.2f);
    const Image a = withNoise(truth, 0.3f, 1), b = withNoise(truth, 0.3f, 2);
    const Image x = withNoise(right, 0.5f, 3), y = withNoise(right, 0.5f, 4);
    const auto d = compareImages({a, b}, {x, y});
    ASSERT_TRUE(d);
    EXPECT_NEAR(d->rmse, 0.2, 0.01);
    EXPECT_NEAR(d->meanRatio, 1.1, 0.002);
}

TEST(ImageMetrics, MeansGoFieldByField) {
    const auto a = compareImages(filled(10, 10, 1), filled(10, 10, 1)),
               b = compareImages(filled(10, 10, 1), filled(10, 10, 3));
    const ImageDifference both[] = {*a, *b};
    const ImageDifference mean = meanOf(both);
    EXPECT_NEAR(mean.meanRatio, 2, 1e-9);
    EXPECT_NEAR(mean.relativeRmse, 1, 1e-9);
    EXPECT_NEAR(mean.toneRmse, 0.125, 1e-6);
}

TEST(ImageMetrics, RefuseSizesAndNotANumber) {
    EXPECT_FALSE(compareImages(Image(2, 2), Image(3, 2)));
    Image bad(2, 2);
    bad.at(1, 1).y = std::nanf("");
    EXPECT_FALSE(compareImages(Image(2, 2), bad));
    EXPECT_FALSE(compareImages({Image(2, 2), bad}, Image(2, 2)));
    EXPECT_FALSE(compareImages({Image(2, 2), Image(2, 3)}, Image(2, 2)));
}

}  // namespace
}  // namespace ag
