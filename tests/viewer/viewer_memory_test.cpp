// What the viewer remembers.
#include <gtest/gtest.h>

#include "tools/viewer/viewer_memory.h"

namespace ag::viewer {
namespace {

TEST(ViewerMemory, ComesBackFromItsText) {
    ViewerMemory memory{.panel = false, .settings = true, .profiler = true};
    memory.overlay.shadowMaps = true;
    memory.window = {.fullscreen = true, .vsync = false};
    EXPECT_EQ(memoryFrom(memoryText(memory)), memory);
    DebugUiState panels;
    PanelState panel;
    useMemory(memory, panels, panel);
    EXPECT_EQ(memoryOf(panels, panel), memory);
}

TEST(ViewerMemory, PassesOverWhatIsNone) {
    EXPECT_EQ(memoryFrom(""), ViewerMemory{});
    EXPECT_EQ(memoryFrom("panel maybe\nweather off\nvsync"), ViewerMemory{});
    ViewerMemory closed;
    closed.panel = false;
    EXPECT_EQ(memoryFrom("rubbish\nx panel on\n"), ViewerMemory{});
    EXPECT_EQ(memoryFrom("weather on\npanel off"), closed);
}

}  // namespace
}  // namespace ag::viewer
