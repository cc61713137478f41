// The lists that interleaved shading keeps on the device.
#include <gtest/gtest.h>

#include <set>

#include "shaders/published/interleaved_shading/lacking.h"
#include "tests/gi_gpu/bench.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
using namespace render;
namespace {

// Whatever lacks light is given it once, by one invocation: at sizes whose tiles end inside a workgroup or
// beyond the screen too.
TEST(InterleavedShading, NotesEachPixelThatLacksLightOnce) {
    for (const glm::uvec2 size : {glm::uvec2(65, 17), glm::uvec2(1, 1), glm::uvec2(72, 48)}) {
        Bench b(*scenegen::buildScene("cornell", 0), size);
        ASSERT_TRUE(applyPreset("acrsm", b.settings));
        b.settings.bounce.valClustering.count = 64;
        b.settings.bounce.ismAtlas.tileSize = 32;
        for (int i = 0; i < 3; ++i)
            b.frame();
        const FrameGraph& graph = b.renderer.graph();
        const auto counts = b.read<uint32_t>(graph.findBuffer("interleaved_shading.lacking_counts"));
        const auto words = b.read<uint32_t>(graph.findBuffer("interleaved_shading.lacking"));
        constexpr uint32_t kSide = 24, kPerTile = kSide * kSide;
        const uint32_t tilesAcross = (size.x + kSide - 1) / kSide;
        std::set<std::pair<uint32_t, uint32_t>> noted;
        uint32_t notes = 0;
        for (uint32_t tile = 0; tile < counts.size(); ++tile)
            for (uint32_t i = 0; i < std::min(counts[tile], kPerTile); ++i, ++notes) {
                const uint32_t inTile = words[tile * kPerTile + i] & ((1u << io::kLackingPixelBits) - 1);
                const glm::uvec2 pixel(tile % tilesAcross * kSide + inTile % kSide,
                                       tile / tilesAcross * kSide + inTile / kSide);
                EXPECT_TRUE(pixel.x < size.x && pixel.y < size.y) << pixel.x << ", " << pixel.y;
                noted.insert({pixel.x, pixel.y});
            }
        EXPECT_GT(notes, 0u) << size.x;
        EXPECT_EQ(noted.size(), notes) << size.x;
    }
}

}  // namespace
}  // namespace ag::gi
