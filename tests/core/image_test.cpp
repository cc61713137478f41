#include "engine/core/image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "engine/core/safe_file.h"

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

std::string file(const char* name) {
    return (fs::path(testing::TempDir()) / name).string();
}

TEST(ImageFiles, FloatsSurviveExactly) {
    const Image image = ramp(17, 9);
    for (const char* name : {"ramp.pfm", "ramp.exr"}) {
        ASSERT_TRUE(saveImage(image, file(name)));
        const auto back = loadImage(file(name));
        ASSERT_TRUE(back) << back.error().message;
        ASSERT_EQ(back->width, 17);
        ASSERT_EQ(back->height, 9);
        EXPECT_EQ(back->pixels, image.pixels) << name;
    }
}

TEST(ImageFiles, ExrKeepsAttributes) {
    Image image = ramp(5, 4);
    image.attributes = {{"noise", "0.0123"}, {"scene", "cornell"}};
    ASSERT_TRUE(saveImage(image, file("attributes.exr")));
    const auto back = loadImage(file("attributes.exr"));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->attributes, image.attributes);
}

TEST(ImageFiles, RefuseWithASentenceAndLeaveNothing) {
    const Status lost = saveImage(ramp(2, 2), "/nonexistent/folder/a.pfm");
    ASSERT_FALSE(lost);
    EXPECT_NE(lost.error().message.find("/nonexistent/folder/a.pfm"), std::string::npos);
    EXPECT_FALSE(saveImage(ramp(2, 2), file("a.gif")));
    EXPECT_FALSE(fs::exists(file("a.gif")));
    EXPECT_FALSE(loadImage(file("missing.exr")));
    std::ofstream(file("short.pfm"), std::ios::binary) << "PF\n100 100\n-1.0\nxx";
    EXPECT_FALSE(loadImage(file("short.pfm")));
    std::ofstream(file("text.exr")) << "not an image";
    EXPECT_FALSE(loadImage(file("text.exr")));
}

TEST(ImageFiles, DamagedExrsAreRefusedInOneLine) {
    ASSERT_TRUE(saveImage(ramp(9, 7), file("whole.exr")));
    const std::string whole = *readFile(file("whole.exr"));
    std::mt19937 random(5);
    int refused = 0;
    for (int i = 0; i < 300; ++i) {
        std::string damaged = whole;
        for (int n = 0; n < 1 + i % 7; ++n)
            damaged[random() % std::min<size_t>(whole.size(), 350)] = char(random());
        ASSERT_TRUE(writeFileSafely(file("damaged.exr"), damaged));
        const auto image = loadImage(file("damaged.exr"));
        if (image) continue;
        ++refused;
        EXPECT_EQ(image.error().message.find('\n'), std::string::npos) << image.error().message;
    }
    EXPECT_GT(refused, 100);
}

// The decoder makes room for as many chunks as an attribute says there are.
TEST(ImageFiles, AnExrOfMoreChunksThanLinesIsRefused) {
    ASSERT_TRUE(saveImage(ramp(9, 7), file("whole.exr")));
    std::string bytes = *readFile(file("whole.exr"));
    const auto withChunks = [&](int32_t count) {
        std::string attribute = std::string("chunkCount\0int\0\4\0\0\0", 19);
        attribute.append(reinterpret_cast<const char*>(&count), sizeof count);
        return bytes.substr(0, 8) + attribute + bytes.substr(8);
    };
    for (const int32_t count : {-1, 8, 0x7fffffff}) {
        ASSERT_TRUE(writeFileSafely(file("chunks.exr"), withChunks(count)));
        const auto image = loadImage(file("chunks.exr"));
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

TEST(ImageMetrics, RefuseSizesAndNotANumber) {
    EXPECT_FALSE(compareImages(Image(2, 2), Image(3, 2)));
    Image bad(2, 2);
    bad.at(1, 1).y = std::nanf("");
    EXPECT_FALSE(compareImages(Image(2, 2), bad));
}

}  // namespace
}  // namespace ag
