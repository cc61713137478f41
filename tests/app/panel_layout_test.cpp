// Panels fit windows of any size, side by side.
#include <gtest/gtest.h>

#include <array>

#include "engine/app/panel_layout.h"

namespace ag {
namespace {

struct Box {
    glm::vec2 from, to;
};
Box largest(const PanelLayout& layout, Dock dock) {
    const DockPlace p = dockPlace(layout, dock);
    const glm::vec2 from = p.corner - p.pivot * p.most;
    return {from, from + p.most};
}

TEST(PanelLayout, TheLargestPanelsFitTheWindowWithoutTouching) {
    for (const glm::vec2 window :
         {glm::vec2(640, 360), {1280, 720}, {1920, 1080}, {3840, 2160}, {7680, 4320}}) {
        const PanelLayout layout{window, panelScale(window.y), true, true};
        std::array<Box, 4> boxes;
        for (size_t i = 0; i < 4; ++i) {
            boxes[i] = largest(layout, Dock(i));
            EXPECT_TRUE(glm::all(glm::greaterThanEqual(boxes[i].from, glm::vec2(0)))) << i;
            EXPECT_TRUE(glm::all(glm::lessThanEqual(boxes[i].to, window))) << i;
            EXPECT_GT(boxes[i].to.x - boxes[i].from.x, 290 * layout.scale) << "room for its widest line";
            EXPECT_GT(boxes[i].to.y - boxes[i].from.y, 90 * layout.scale);
        }
        for (size_t a = 0; a < 4; ++a)
            for (size_t b = a + 1; b < 4; ++b) {
                const bool apart = glm::any(glm::lessThan(boxes[a].to, boxes[b].from)) ||
                                   glm::any(glm::lessThan(boxes[b].to, boxes[a].from));
                EXPECT_TRUE(apart) << a << " and " << b << " at " << window.x;
            }
    }
}

TEST(PanelLayout, APanelAloneHasItsSideToItself) {
    const PanelLayout shared{{640, 360}, 1, true, true}, alone{{640, 360}, 1, false, false};
    for (const Dock dock : {Dock::kLeft, Dock::kRight})
        EXPECT_GT(dockPlace(alone, dock).most.y, 1.5f * dockPlace(shared, dock).most.y);
}

TEST(PanelLayout, TextGrowsWithTheWindow) {
    EXPECT_EQ(panelScale(360), 1);
    EXPECT_EQ(panelScale(1080), 1);
    EXPECT_EQ(panelScale(1440), 1.5f);
    EXPECT_EQ(panelScale(2160), 2);
    EXPECT_EQ(panelScale(4320), 4);
}

}  // namespace
}  // namespace ag
