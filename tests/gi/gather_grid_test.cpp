// Which pixels light is gathered at while nothing changes.
#include "gi/gather_grid.h"

#include <gtest/gtest.h>

#include <set>

namespace ag::gi {
namespace {

BounceLightSettings shortTurns(uint32_t spacing) {
    BounceLightSettings s;
    s.spacing = spacing;
    s.texelRays.settleFrames = 8;
    s.valClustering.settleFrames = 6;
    return s;
}

TEST(GatherGrid, EveryPixelOfASquareHasOneTurn) {
    for (const uint32_t spacing : {1u, 2u, 3u}) {
        const BounceLightSettings s = shortTurns(spacing);
        GatherGridHistory history;
        std::set<std::pair<uint32_t, uint32_t>> places;
        uint32_t begun = 0;
        GatherGrid grid;
        for (uint32_t frame = 0; frame < framesToRest(s); ++frame) {
            grid = chooseGatherGrid(7, 0, true, s, history);
            if (!grid.begins) continue;
            EXPECT_EQ(grid.turn, begun++);
            EXPECT_TRUE(places.emplace(grid.place.x, grid.place.y).second) << "two turns of one pixel";
        }
        EXPECT_EQ(places.size(), spacing * spacing);
        for (int more = 0; more < 100; ++more) {
            const GatherGrid later = chooseGatherGrid(7, 0, true, s, history);
            EXPECT_EQ(later.turn, grid.turn);
            EXPECT_FALSE(later.begins);
        }
    }
}

TEST(GatherGrid, TheMiddleIsFirstAndAllTurnsHaveAsManyRays) {
    const BounceLightSettings s = shortTurns(2);
    GatherGridHistory history;
    const GatherGrid first = chooseGatherGrid(1, 0, true, s, history);
    EXPECT_EQ(first.place, glm::uvec2(1));
    GatherGrid last = first;
    for (uint32_t frame = 1; frame < framesToRest(s); ++frame)
        last = chooseGatherGrid(1, 0, true, s, history);
    EXPECT_EQ(last.turn, 3u);
    EXPECT_EQ(last.frames, first.frames);
}

TEST(GatherGrid, ChangesBeginAnew) {
    BounceLightSettings s = shortTurns(2);
    GatherGridHistory history;
    const auto rest = [&](uint64_t light) {
        GatherGrid grid;
        for (uint32_t frame = 0; frame < framesToRest(s); ++frame)
            grid = chooseGatherGrid(light, 0, true, s, history);
        return grid.turn;
    };
    EXPECT_EQ(rest(1), 3u);
    EXPECT_EQ(chooseGatherGrid(2, 0, true, s, history).turn, 0u) << "other light";
    EXPECT_EQ(rest(2), 3u);
    s.valShading.taps += 1;
    EXPECT_EQ(chooseGatherGrid(2, 0, true, s, history).turn, 0u) << "other settings";
    EXPECT_EQ(rest(2), 3u);
    s.texelRays.allPixels = false;
    EXPECT_EQ(rest(2), 0u);
}

TEST(GatherGrid, WithoutRaysTheMiddleHasAllTurns) {
    const BounceLightSettings s = shortTurns(2);
    GatherGridHistory history;
    for (uint32_t frame = 0; frame < 2 * framesToRest(s); ++frame)
        EXPECT_EQ(chooseGatherGrid(1, 0, false, s, history).place, glm::uvec2(1));
    const GatherGrid first = chooseGatherGrid(1, 0, true, s, history);
    EXPECT_TRUE(first.begins) << "once rays can be cast they have all their frames";
    EXPECT_EQ(first.turn, 0u);
}

// Anti-aliasing moves samples in the pixels: light is gathered anew, but rays go on.
TEST(GatherGrid, OtherSamplesOfPixelsAreNoChangeOfLight) {
    const BounceLightSettings s = shortTurns(2);
    GatherGridHistory history;
    const GatherGrid first = chooseGatherGrid(1, 0, true, s, history);
    EXPECT_FALSE(first.still);
    for (uint64_t sample = 1; sample < 8; ++sample) {
        const GatherGrid grid = chooseGatherGrid(1, sample, true, s, history);
        EXPECT_TRUE(grid.still && grid.begins);
        EXPECT_EQ(grid.change, first.change);
    }
    const GatherGrid other = chooseGatherGrid(2, 7, true, s, history);
    EXPECT_FALSE(other.still);
    EXPECT_NE(other.change, first.change);
}

TEST(GatherGrid, TheFirstTurnLastsUntilAllLightRests) {
    BounceLightSettings s = shortTurns(2);
    GatherGridHistory history;
    EXPECT_EQ(chooseGatherGrid(1, 0, true, s, history).frames, 8u);
    s.valClustering.settleFrames = 20;
    EXPECT_EQ(chooseGatherGrid(1, 0, true, s, history).frames, 20u);
    s.laterBounces = {.enabled = true, .settleFrames = 30};
    s.sky.settleFrames = 10;
    EXPECT_EQ(chooseGatherGrid(1, 0, true, s, history).frames, 40u)
        << "the last ray would count in each frame in which later bounces change";
    for (int frame = 1; frame <= 40; ++frame)
        EXPECT_EQ(chooseGatherGrid(1, 0, true, s, history).turn, 0u);
    EXPECT_EQ(chooseGatherGrid(1, 0, true, s, history).turn, 1u);
}

}  // namespace
}  // namespace ag::gi
