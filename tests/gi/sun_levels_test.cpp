// Levels of a sun's map: together they are the whole map, once, and follow the camera in steps.
#include <gtest/gtest.h>

#include <cstring>

#include "gi/rsm_views.h"
#include "gi/sun_levels.h"

namespace ag::gi {
namespace {

constexpr uint32_t kSize = 512;
constexpr float kDetail = 1.0f / 160;

struct Sun {
    Bounds bounds{glm::vec3(-500, 0, -500), glm::vec3(500, 12, 500)};
    LightView whole = sunView(glm::normalize(glm::vec3(0.3f, -1, 0.2f)), bounds, 0.02f);
    SunLevelsHistory history;
    std::array<SunLevel, io::kMostSunLevels> room;

    std::span<const SunLevel> levels(const SunFocus& focus) {
        return layOutSunLevels(whole, kSize, focus, kDetail, history, room);
    }
};

// How many of the levels have a place.
int levelsWith(std::span<const SunLevel> levels, glm::vec3 place) {
    int found = 0;
    for (const SunLevel& level : levels) {
        const glm::vec2 clip(level.view.clipFromWorld * glm::vec4(place, 1));
        const glm::vec2 at = (clip * 0.5f + 0.5f) * float(kSize);
        const bool inside = glm::all(glm::greaterThanEqual(at, glm::vec2(0))) &&
                            glm::all(glm::lessThan(at, glm::vec2(kSize)));
        const glm::vec2 begin(level.holeBegin);
        const bool inHole = glm::all(glm::greaterThanEqual(at, begin)) &&
                            glm::all(glm::lessThan(at, begin + float(level.holeSize)));
        found += inside && !inHole;
    }
    return found;
}

TEST(SunLevels, HaveEveryPlaceOnce) {
    Sun sun;
    const auto levels = sun.levels({.eye = {120, 2, -80}, .distance = 15});
    ASSERT_EQ(levels.size(), 3u);
    int both = 0;
    for (int z = 0; z < 97; ++z)
        for (int x = 0; x < 97; ++x) {
            const glm::vec3 place(-499 + 998 * (float(x) + 0.37f) / 97, 1,
                                  -499 + 998 * (float(z) + 0.41f) / 97);
            both += levelsWith(levels, place) != 1;
        }
    EXPECT_EQ(both, 0);
    for (float aside = -20; aside <= 20; aside += 0.61f)
        EXPECT_EQ(levelsWith(levels, {120 + aside, 1, -80 - aside}), 1);
}

TEST(SunLevels, AreAsFineAsWhatIsSeenAsksFor) {
    Sun sun;
    EXPECT_EQ(sun.levels({}).size(), 1u) << "nobody knows yet what is seen";
    EXPECT_EQ(sun.levels({.eye = {0, 2, 0}, .distance = 400}).size(), 1u);
    const auto levels = sun.levels({.eye = {0, 2, 0}, .distance = 15});
    EXPECT_LT(2 * levels.back().view.tanHalf / kSize, 2.5f * kDetail * 15);
    const glm::vec4 clip = levels.back().view.clipFromWorld * glm::vec4(0, 2, 0, 1);
    EXPECT_LT(std::max(std::abs(clip.x), std::abs(clip.y)), 0.3f)
        << "the camera is in the finest one's middle";
}

TEST(SunLevels, StayUntilTheCameraHasGoneSomeWay) {
    Sun sun;
    const auto beginOf = [&](float x) { return sun.levels({.eye = {x, 2, 0}, .distance = 15})[1].holeBegin; };
    beginOf(0);
    int changes = 0;
    glm::uvec2 before = beginOf(0);
    for (int frame = 0; frame < 400; ++frame) {  // to and fro across any border of a step
        const glm::uvec2 now = beginOf(frame % 2 ? 0.5f : -0.5f);
        changes += now != before;
        before = now;
    }
    EXPECT_LE(changes, 1);
    EXPECT_NE(beginOf(60), before) << "it follows";
}

TEST(SunLevels, KeepTheDistanceThatIsNearlyWhatItWas) {
    EXPECT_EQ(steadyDistance(15, 0), 15);
    EXPECT_EQ(steadyDistance(20, 15), 15);
    EXPECT_EQ(steadyDistance(40, 15), 40);
    EXPECT_EQ(steadyDistance(5, 15), 5);
}

std::vector<io::ViewPoint> pointsFrom(float x) {
    std::vector<io::ViewPoint> points(io::kViewPointCount);
    for (size_t i = 0; i < 101; ++i)
        points[i] = {.position = {x + float(i), 0, 0}, .weight = 1};
    return points;
}

TEST(SunLevels, TakeTheMedianOfWhatIsSeen) {
    SunFocusHistory history;
    const auto seen = pointsFrom(0);
    const auto follow = [&](std::span<const io::ViewPoint> points, float x) {
        return followFocus(std::as_bytes(points), {x, 0, 0}, history).distance;
    };
    for (uint32_t frame = 0; frame < kFramesInFlight; ++frame)
        EXPECT_EQ(follow({}, 0), 0) << "nothing was read back yet";
    EXPECT_NEAR(follow(seen, 0), 50, 1);
    const std::vector<io::ViewPoint> sky(io::kViewPointCount);
    EXPECT_NEAR(follow(sky, 0), 50, 1) << "the sky alone is seen";
}

TEST(SunLevels, MeasureWhatIsSeenFromWhereItWasSeen) {
    SunFocusHistory history;
    for (uint32_t frame = 0; frame < kFramesInFlight; ++frame)
        followFocus({}, {0, 0, 0}, history);
    const auto before = pointsFrom(0), after = pointsFrom(5000);
    for (uint32_t frame = 0; frame < 3 * kFramesInFlight; ++frame) {  // another origin, or another place
        const auto& read = frame < kFramesInFlight ? before : after;
        EXPECT_NEAR(followFocus(std::as_bytes(std::span(read)), {5000, 0, 0}, history).distance, 50, 1);
    }
}

}  // namespace
}  // namespace ag::gi
