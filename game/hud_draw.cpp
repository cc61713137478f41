// The HUD's drawing, apart from what it says.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "game/hud.h"

namespace ag::game {
namespace {

constexpr float kTau = 6.2831853f;
constexpr ImU32 kInk = IM_COL32(240, 236, 225, 255), kShade = IM_COL32(0, 0, 0, 140);

ImU32 colorOf(glm::vec3 c, float alpha = 1) {
    const glm::vec3 lifted = glm::pow(glm::clamp(c, 0.0f, 1.0f), glm::vec3(1 / 2.2f));
    return ImGui::ColorConvertFloat4ToU32({lifted.x, lifted.y, lifted.z, alpha});
}

// Corners about the middle; a star and a cross go in and out.
std::vector<ImVec2> outline(Shape shape, ImVec2 at, float r) {
    const auto polygon = [&](int corners, float turn, float inner) {
        std::vector<ImVec2> points;
        for (int i = 0; i < corners; ++i) {
            const float a = turn + kTau * float(i) / float(corners), d = i % 2 ? r * inner : r;
            points.push_back({at.x + d * std::sin(a), at.y - d * std::cos(a)});
        }
        return points;
    };
    if (shape == Shape::kTriangle) return polygon(3, 0, 1);
    if (shape == Shape::kSquare) return polygon(4, kTau / 8, 1);
    if (shape == Shape::kDiamond) return polygon(4, 0, 1);
    if (shape == Shape::kStar) return polygon(10, 0, 0.45f);
    if (shape == Shape::kCross) return polygon(8, kTau / 8, 0.35f);
    if (shape == Shape::kHexagon) return polygon(6, 0, 1);
    return polygon(18, 0, 1);
}

void drawShape(ImDrawList& list, Shape shape, ImVec2 at, float r, ImU32 color, float filled) {
    const std::vector<ImVec2> points = outline(shape, at, r);
    if (filled > 0) {
        list.PushClipRect({at.x - r, at.y + r - 2 * r * filled}, {at.x + r, at.y + r}, true);
        // About the middle, as convex shapes are not the only ones.
        for (size_t i = 0; i < points.size(); ++i)
            list.AddTriangleFilled(at, points[i], points[(i + 1) % points.size()], color);
        list.PopClipRect();
    }
    list.AddPolyline(points.data(), int(points.size()), color, ImDrawFlags_Closed, 1.5f);
}

// Text with a shade behind it; returns its width.
float drawText(ImDrawList& list, ImVec2 at, const char* text, ImU32 color = kInk) {
    const ImVec2 size = ImGui::CalcTextSize(text);
    list.AddRectFilled({at.x - 4, at.y - 2}, {at.x + size.x + 4, at.y + size.y + 2}, kShade, 3);
    list.AddText(at, color, text);
    return size.x;
}

// Its last line ends at `bottom`; what is too wide is broken.
void drawCentered(ImDrawList& list, float bottom, float width, const std::string& text) {
    if (text.empty()) return;
    const float most = width - 40;
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, most);
    const ImVec2 at((width - size.x) / 2, bottom - size.y);
    list.AddRectFilled({at.x - 4, at.y - 2}, {at.x + size.x + 4, bottom + 2}, kShade, 3);
    list.AddText(nullptr, 0, at, kInk, text.c_str(), nullptr, most);
}

// Three bars: a frame as high as the wish, filled as high as what is received.
void drawBars(ImDrawList& list, ImVec2 at, float height, const FlowerLine& flower) {
    static constexpr const char* kChannels[] = {"R", "G", "B"};
    for (int c = 0; c < 3; ++c) {
        const float x = at.x + 13 * float(c), base = at.y + height;
        glm::vec3 pure(0.12f);
        pure[c] = 1;
        const float wish = height * std::clamp(flower.wants[c], 0.03f, 1.0f);
        const float has = height * std::clamp(flower.received[c], 0.0f, 1.25f);
        list.AddRectFilled({x, base - has}, {x + 9, base}, colorOf(pure, 0.85f));
        list.AddRect({x, base - wish}, {x + 9, base}, kInk);
        list.AddText({x + 1, base + 1}, kInk, kChannels[c]);
    }
}

std::string openText(const FlowerLine& flower) {
    if (flower.mood == FlowerMood::kOpen || flower.openness <= 0) return "";
    return fmt::format("{} %{}", int(flower.openness * 100), flower.closing ? ", closing" : "");
}

// How near its light is to opening it: a bar from gray to the flower's own colour.
void drawPromise(ImDrawList& list, ImVec2 at, float width, const FlowerLine& flower) {
    const glm::vec3 gray(0.2f), color = glm::mix(gray, flower.wants, flower.promise);
    list.AddRectFilled(at, {at.x + width * flower.promise, at.y + 3}, colorOf(color));
    list.AddRect(at, {at.x + width, at.y + 3}, IM_COL32(240, 236, 225, 90));
}

// Pixels; nothing for what is behind the eyes.
std::optional<glm::vec2> onScreen(glm::dvec3 position, glm::vec2 size, const HudView& view) {
    const glm::vec4 clip = view.clipFromWorld * glm::vec4(glm::vec3(position - view.origin), 1);
    if (clip.w < 0.3f) return std::nullopt;
    return (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * size;
}

// A line from its row to the flower, or to the edge of the screen on the side where it is.
void pointAt(ImDrawList& list, ImVec2 from, glm::vec2 size, const FlowerLine& flower, const HudView& view) {
    constexpr float kEdge = 14;
    const glm::vec4 clip = view.clipFromWorld * glm::vec4(glm::vec3(flower.position - view.origin), 1);
    glm::vec2 at =
        onScreen(flower.position, size, view).value_or(glm::vec2(clip.x < 0 ? 0 : size.x, size.y / 2));
    const glm::vec2 inside = glm::clamp(at, glm::vec2(kEdge), size - kEdge);
    const bool seen = inside == at;
    list.AddLine(from, {inside.x, inside.y}, IM_COL32(240, 236, 225, 70), 1);
    if (seen) return;
    const glm::vec2 way = glm::normalize(inside - size * 0.5f), side(-way.y, way.x);
    const glm::vec2 tip = inside + way * 8.0f, a = inside + side * 6.0f, b = inside - side * 6.0f;
    list.AddTriangleFilled({tip.x, tip.y}, {a.x, a.y}, {b.x, b.y}, colorOf(flower.wants));
}

void drawFlowers(ImDrawList& list, glm::vec2 size, const std::vector<FlowerLine>& flowers, bool legend,
                 const HudView& view) {
    constexpr float kWidth = 178, kHeight = 34;
    float y = 28;
    for (const FlowerLine& flower : flowers) {
        const float x = size.x - kWidth - 6;
        list.AddRectFilled({x, y}, {x + kWidth, y + kHeight + 18}, kShade, 4);
        if (flower.meant) list.AddRect({x, y}, {x + kWidth, y + kHeight + 18}, kInk, 4);
        const Shape shape = shapeOf(flower.wants);
        drawShape(list, shape, {x + 16, y + 18}, 10, colorOf(flower.wants), flower.openness);
        if (!flower.shy) drawBars(list, {x + 34, y + 4}, kHeight - 2, flower);
        drawPromise(list, {x + 6, y + kHeight + 12}, kWidth - 12, flower);
        const std::string open = openText(flower);
        const char* lines[] = {flower.shy ? "darkness" : shapeName(shape), moodText(flower), open.c_str()};
        for (int i = 0; i < 3; ++i)
            list.AddText({x + 78, y + 1 + 14 * float(i)}, kInk, lines[i]);
        if (flower.meant) pointAt(list, {x, y + 18}, size, flower, view);
        y += kHeight + 24;
    }
    if (legend && !flowers.empty()) {
        const char* text = "frame: wanted, fill: received";
        drawText(list, {size.x - ImGui::CalcTextSize(text).x - 10, y}, text);
    }
}

// Over each flower's head, where it is before the eyes.
void drawMarks(ImDrawList& list, glm::vec2 size, const std::vector<FlowerLine>& flowers,
               const HudView& view) {
    for (const FlowerLine& flower : flowers) {
        const glm::vec4 clip = view.clipFromWorld * glm::vec4(glm::vec3(flower.position - view.origin), 1);
        const auto at = onScreen(flower.position, size, view);
        if (!at) continue;
        const float r = std::clamp(24 / clip.w, 4.0f, 12.0f);
        drawShape(list, shapeOf(flower.wants), {at->x, at->y - r}, r + 1.5f, kShade, 0);
        drawShape(list, shapeOf(flower.wants), {at->x, at->y - r}, r, colorOf(flower.wants, 0.9f),
                  flower.openness);
    }
}

// At the left, above the hints, the newest at the bottom.
void drawSubtitles(ImDrawList& list, glm::vec2 size, const std::vector<std::string>& heard) {
    float y = size.y * 0.72f;
    for (size_t i = heard.size(); i-- > 0; y -= ImGui::GetTextLineHeight() + 4)
        drawText(list, {10, y}, fmt::format("[{}]", heard[i]).c_str());
}

}  // namespace

void drawHud(const HudState& hud, glm::vec2 size, const HudView& view) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    drawMarks(list, size, hud.flowers, view);
    drawFlowers(list, size, hud.flowers, hud.legend, view);
    drawText(list, {size.x - ImGui::CalcTextSize(hud.goal.c_str()).x - 10, 8}, hud.goal.c_str());
    // Dark about light: it is seen on bright walls, too.
    list.AddCircleFilled({size.x / 2, size.y / 2}, 3.5f, IM_COL32(0, 0, 0, 150));
    list.AddCircleFilled({size.x / 2, size.y / 2}, 2, IM_COL32(255, 255, 255, 220));
    drawCentered(list, size.y - 26, size.x, hud.hint.empty() ? hud.rule : hud.hint);
    const char* hands = hud.carrying ? "put down" : hud.crateInReach ? "pick up" : nullptr;
    if (hands) drawText(list, {size.x / 2 + 12, size.y / 2 + 8}, hands);
    drawCentered(list, size.y - 6, size.x, hud.notice);
    drawSubtitles(list, size, hud.heard);
}

void drawPhotoLines(const std::vector<std::string>& lines, const std::string& keys, glm::vec2 size) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    float y = 46;  // below messages
    for (const std::string& line : lines) {
        drawText(list, {10, y}, line.c_str());
        y += ImGui::GetTextLineHeight() + 4;
    }
    drawCentered(list, size.y - 6, size.x, keys);
}

void drawMessage(const std::string& text) {
    if (!text.empty()) drawText(*ImGui::GetForegroundDrawList(), {10, 26}, text.c_str());
}

}  // namespace ag::game
