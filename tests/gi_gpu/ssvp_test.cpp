// Screen-space VPL propagation: what its two lists of lights carry, in a closed room of fine triangles.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/gi_gpu/bench.h"
#include "tools/scenegen/builder.h"

namespace ag::gi {
using namespace render;
namespace {

constexpr float kAlbedo = 0.5f;

// A cube of 2 m seen from inside. Paraboloids bend triangles at their corners alone, so they have to be
// small.
SceneAsset fineRoom() {
    scenegen::SceneBuilder b("room");
    const uint32_t gray = b.material("gray", glm::vec3(kAlbedo));
    scenegen::MeshParts walls;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f})
            addSheet(
                walls, gray,
                [&](float u, float v) {
                    glm::vec3 p;
                    p[axis] = side;
                    p[(axis + 1) % 3] = side * (1 - 2 * u);
                    p[(axis + 2) % 3] = 2 * v - 1;
                    return p;
                },
                32, 32);
    b.model("walls", walls, glm::vec3(0));
    b.point("lamp", {0, 0, 0}, glm::vec3(1));
    b.camera("camera", {0.7f, 0.2f, 0.8f}, {-0.5f, -0.2f, -0.6f}, 60);
    return b.finish();
}

struct Lists {
    std::vector<io::Val> first, second;
};

Lists listsOf(const SsvpSettings& settings, int frames = 2) {
    Bench b(fineRoom(), {64, 36});
    applyPreset("ssvp", b.settings);
    b.settings.ssvp = settings;
    b.output = [](GraphScope scope, const RenderFrame& f) { scope.output(f.bounce.vals.vals); };
    for (int i = 0; i < frames; ++i)
        b.frame();
    const std::vector<io::Val> all = b.read<io::Val>(b.last.bounce.vals.vals);
    const auto end = all.begin() + b.last.bounce.firstCount;
    return {{all.begin(), end}, {end, end + settings.secondCount}};
}

double fluxOf(const std::vector<io::Val>& vals) {
    double sum = 0;
    for (const io::Val& v : vals)
        sum += double(v.flux.x);
    return sum;
}

double wastedShare(const std::vector<io::Val>& vals) {
    return double(std::ranges::count(vals, 0.0f, [](const io::Val& v) { return v.flux.x; })) /
           double(vals.size());
}

TEST(Ssvp, EachBounceCarriesItsShareOfTheLight) {
    const double light = 4 * 3.14159265;
    for (const uint32_t clusters : {4u, 32u})
        for (const bool disk : {true, false}) {
            const Lists lists = listsOf({.clusters = clusters, .secondCount = 1024, .disk = disk});
            const double first = fluxOf(lists.first), second = fluxOf(lists.second);
            std::printf("%u clusters, %s: first bounce %.3f of the truth, second %.3f, %.1f %% wasted\n",
                        clusters, disk ? "disk" : "square", first / (kAlbedo * light),
                        second / (kAlbedo * kAlbedo * light), 100 * wastedShare(lists.second));
            EXPECT_NEAR(first / (kAlbedo * light), 1, 0.02);
            EXPECT_NEAR(second / (kAlbedo * kAlbedo * light), 1, 0.03);
        }
}

// SSVP figure 2: of the square, the corners outside the disk show nothing.
TEST(Ssvp, SamplesOfTheDiskAreNotWasted) {
    EXPECT_LT(wastedShare(listsOf({.clusters = 8, .secondCount = 1024}).second), 0.02);
    EXPECT_NEAR(wastedShare(listsOf({.clusters = 8, .secondCount = 1024, .disk = false}).second),
                1 - 3.14159265 / 4, 0.02);
}

TEST(Ssvp, LightsLieOnSurfacesAndFaceTheRoom) {
    for (const io::Val& v : listsOf({.clusters = 8, .secondCount = 256}).second) {
        if (v.flux.x == 0) continue;
        const glm::vec3 a = glm::abs(v.position);
        EXPECT_NEAR(std::max(a.x, std::max(a.y, a.z)), 1, 1e-3);
        EXPECT_LT(glm::dot(v.position, v.normal), -0.99f);
    }
}

TEST(Ssvp, ClustersStayWhileNothingMoves) {
    const SsvpSettings settings{.clusters = 8, .secondCount = 256};
    const Lists early = listsOf(settings, 2), late = listsOf(settings, 6);
    EXPECT_TRUE(std::ranges::equal(early.second, late.second, {}, &io::Val::position, &io::Val::position));
}

}  // namespace
}  // namespace ag::gi
