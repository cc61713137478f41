// Where panels are docked: a fixed layout that fits windows from 640x360 to 4K and more, and the size of
// their text by the window's height.
#pragma once

#include <glm/glm.hpp>

namespace ag {

enum class Dock { kLeft, kRight, kBottomLeft, kBottomRight };

struct PanelLayout {
    glm::vec2 window{640, 360};                    // pixels
    float scale = 1;                               // of text and of all sizes
    bool sharesLeft = false, sharesRight = false;  // a panel at the bottom of that side is open, too
};

// 1 up to 1080 lines, 2 at 4K, in steps of a half.
float panelScale(float windowHeight);

struct DockPlace {
    glm::vec2 corner{0};  // pixels, of the window, that the panel's own touches
    glm::vec2 pivot{0};   // which corner of the panel: 0 left or top, 1 right or bottom
    glm::vec2 most{0};    // pixels: a panel is as large as its content, up to this; beyond it scrolls
};
DockPlace dockPlace(const PanelLayout& layout, Dock dock);

// Within an ImGui frame, before the panel's Begin, which has kDockedFlags.
void dockNextPanel(const PanelLayout& layout, Dock dock);
extern const int kDockedFlags;  // ImGuiWindowFlags

// Text as large as the scale asks: fonts are made for 1 and for 2, other sizes stretch the nearer one.
void makeScaledFonts();      // once, before the fonts' texture is
void useScale(float scale);  // before a frame
float uiScale();             // within one: of numbers of pixels at scale 1

}  // namespace ag
