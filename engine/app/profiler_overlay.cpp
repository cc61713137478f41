#include "engine/app/profiler_overlay.h"

#include <imgui.h>

#include <algorithm>
#include <numeric>

namespace ag {
namespace {

constexpr glm::vec2 kGraph{480, 120};  // pixels at scale 1
constexpr float kLeastGraph = 200;     // the same, across

// Far apart for neighbours in the order of the frame, also for eyes that see less colour: light and dark take
// turns.
ImU32 colorOf(size_t technique) {
    const float hue = float(technique * 7 % 18) / 18.0f, value = technique % 2 ? 0.95f : 0.65f;
    float r = 0, g = 0, b = 0;
    ImGui::ColorConvertHSVtoRGB(hue, 0.6f, value, r, g, b);
    return ImGui::ColorConvertFloat4ToU32({r, g, b, 1});
}

// ms at the graph's top: the budget and the usual frame stay in sight, a spike runs out of it.
double topOf(const PassHistory& history, double budgetMs) {
    return std::max({1.25 * budgetMs, 2 * history.medianMs(), 0.01});
}

void drawColumns(const PassHistory& history, ImVec2 at, glm::vec2 size, double top, double budgetMs) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float step = size.x / float(PassHistory::kFrames);
    list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, IM_COL32(0, 0, 0, 110));
    float x = at.x + size.x - step * float(history.frames().size());
    for (const FrameCost& frame : history.frames()) {
        float below = 0;
        for (size_t t = 0; t < frame.techniques.size(); ++t) {
            const float upTo = std::min(below + frame.techniques[t] * size.y / float(top), size.y);
            if (upTo - below > 0.1f)
                list.AddRectFilled({x, at.y + size.y - upTo}, {x + step, at.y + size.y - below}, colorOf(t));
            below = upTo;
        }
        if (frame.ms > top) list.AddRectFilled({x, at.y}, {x + step, at.y + 4}, IM_COL32_WHITE);
        x += step;
    }
    const float y = at.y + size.y * (1 - float(budgetMs / top));
    list.AddLine({at.x, y}, {at.x + size.x, y}, IM_COL32(255, 90, 60, 255), 1.5f);
    char text[32];
    std::snprintf(text, sizeof text, "%.1f ms", budgetMs);
    const ImVec2 label = ImGui::CalcTextSize(text), corner(at.x + 4, y - label.y - 2);
    list.AddRectFilled(corner, {corner.x + label.x, corner.y + label.y}, IM_COL32(0, 0, 0, 160));
    list.AddText(corner, IM_COL32(255, 140, 110, 255), text);
}

// The techniques that usually cost most, with their colours.
void legend(const PassHistory& history) {
    std::vector<double> ms(history.techniques().size());
    for (size_t t = 0; t < ms.size(); ++t)
        ms[t] = history.medianMs(t);
    std::vector<size_t> order(ms.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::ranges::sort(order, [&](size_t a, size_t b) { return ms[a] > ms[b]; });
    constexpr size_t kShown = 12;
    if (!ImGui::BeginTable("techniques", 3)) return;
    for (size_t i = 0; i < std::min(order.size(), kShown); ++i) {
        ImGui::TableNextColumn();
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float s = uiScale();
        ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + 3 * s}, {at.x + 9 * s, at.y + 12 * s},
                                                  colorOf(order[i]));
        ImGui::Dummy({11 * s, 12 * s});
        ImGui::SameLine(0, 3);
        ImGui::Text("%.2f %s", ms[order[i]], history.techniques()[order[i]].c_str());
    }
    ImGui::EndTable();
}

void spikeList(PassHistory& history) {
    if (history.spikes().empty()) return;
    ImGui::TextUnformatted("spikes");
    ImGui::SameLine();
    if (ImGui::SmallButton("forget")) return history.forgetSpikes();
    for (const FrameCost& spike : history.spikes())
        ImGui::Text("frame %llu: %.1f ms, of these %s %.1f", static_cast<unsigned long long>(spike.frame),
                    spike.ms, spike.worst.c_str(), spike.worstMs);
}

// Narrower where the window is.
glm::vec2 graphSize(const PanelLayout& layout) {
    constexpr float kFrameOfPanel = 40;  // pixels at scale 1, with the scroll bar
    const float room = dockPlace(layout, Dock::kBottomLeft).most.x - kFrameOfPanel * layout.scale;
    return {std::clamp(room, kLeastGraph * layout.scale, kGraph.x * layout.scale), kGraph.y * layout.scale};
}

}  // namespace

void drawProfiler(const PanelLayout& layout, PassHistory& history, float& budgetMs) {
    dockNextPanel(layout, Dock::kBottomLeft);
    ImGui::Begin("Profiler", nullptr, kDockedFlags);
    const double last = history.frames().empty() ? 0 : history.frames().back().ms;
    ImGui::Text("device %.2f ms, median %.2f ms of %zu frames", last, history.medianMs(),
                history.frames().size());
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const glm::vec2 graph = graphSize(layout);
    ImGui::Dummy({graph.x, graph.y});
    drawColumns(history, at, graph, topOf(history, budgetMs), budgetMs);
    legend(history);
    ImGui::SetNextItemWidth(160 * uiScale());
    ImGui::SliderFloat("ms of budget", &budgetMs, 1, 500, "%.1f", ImGuiSliderFlags_Logarithmic);
    spikeList(history);
    ImGui::End();
}

}  // namespace ag
