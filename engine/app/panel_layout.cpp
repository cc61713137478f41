#include "engine/app/panel_layout.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace ag {
namespace {

constexpr float kFontPixels = 13;           // of ImGui's own font at scale 1
constexpr float kMargin = 8, kStatus = 32;  // pixels at scale 1; the status line's, above all panels
constexpr float kMostWidth = 0.49f;         // of the window: both sides fit side by side
constexpr float kUpperShare = 0.6f;         // of the height, where another panel is below

}  // namespace

const int kDockedFlags = ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_HorizontalScrollbar;

float panelScale(float windowHeight) {
    constexpr float kPlain = 1080;
    return std::max(1.0f, std::round(windowHeight / kPlain * 2) / 2);
}

DockPlace dockPlace(const PanelLayout& l, Dock dock) {
    const float margin = kMargin * l.scale, top = kStatus * l.scale + margin;
    const bool right = dock == Dock::kRight || dock == Dock::kBottomRight;
    const bool bottom = dock == Dock::kBottomLeft || dock == Dock::kBottomRight;
    const bool shares = bottom || (right ? l.sharesRight : l.sharesLeft);
    const float height = std::max(l.window.y - top - margin, 1.0f);
    const float share = !shares ? 1 : bottom ? 1 - kUpperShare : kUpperShare;
    return {{right ? l.window.x - margin : margin, bottom ? l.window.y - margin : top},
            {right ? 1 : 0, bottom ? 1 : 0},
            {kMostWidth * l.window.x - margin, share * height - (shares && !bottom ? margin : 0)}};
}

void dockNextPanel(const PanelLayout& layout, Dock dock) {
    const DockPlace place = dockPlace(layout, dock);
    ImGui::SetNextWindowPos({place.corner.x, place.corner.y}, ImGuiCond_Always,
                            {place.pivot.x, place.pivot.y});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {place.most.x, place.most.y});
    ImGui::SetNextWindowBgAlpha(0.8f);
}

void makeScaledFonts() {
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    for (const float scale : {1.0f, 2.0f}) {
        ImFontConfig config;
        config.SizePixels = kFontPixels * scale;
        fonts.AddFontDefault(&config);
    }
}

void useScale(float scale) {
    ImGuiIO& io = ImGui::GetIO();
    io.FontDefault = io.Fonts->Fonts[scale >= 1.5f ? 1 : 0];
    const float stretched = scale * kFontPixels / io.FontDefault->FontSize;
    if (io.FontGlobalScale == stretched && ImGui::GetStyle().WindowPadding.x == std::floor(8 * scale)) return;
    io.FontGlobalScale = stretched;
    ImGui::GetStyle() = ImGuiStyle();
    ImGui::GetStyle().ScaleAllSizes(scale);
}

float uiScale() {
    return ImGui::GetFontSize() / kFontPixels;
}

}  // namespace ag
