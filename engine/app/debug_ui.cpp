#include "engine/app/debug_ui.h"

#include <imgui.h>
#include <imgui/backends/imgui_impl_glfw.h>

#include <algorithm>
#include <cfloat>
#include <iterator>

namespace ag {
namespace {

void editSetting(const Setting& s) {
    if (bool* const* flag = std::get_if<bool*>(&s.value)) {
        ImGui::Checkbox(s.info.name.c_str(), *flag);
    } else if (float* const* number = std::get_if<float*>(&s.value)) {
        ImGui::SliderFloat(s.info.name.c_str(), *number, float(s.info.min), float(s.info.max), "%.3f",
                           ImGuiSliderFlags_AlwaysClamp);
    } else if (uint32_t* const* value = std::get_if<uint32_t*>(&s.value)) {
        int edited = int(**value);
        if (s.info.choices.empty()) {
            if (ImGui::SliderInt(s.info.name.c_str(), &edited, int(s.info.min), int(s.info.max), "%d",
                                 ImGuiSliderFlags_AlwaysClamp))
                **value = uint32_t(edited);
        } else if (ImGui::BeginCombo(s.info.name.c_str(), s.info.choices[**value].c_str())) {
            for (size_t i = 0; i < s.info.choices.size(); ++i)
                if (ImGui::Selectable(s.info.choices[i].c_str(), i == **value)) **value = uint32_t(i);
            ImGui::EndCombo();
        }
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", s.info.help.c_str());
}

void settingsPanel(const PanelLayout& layout, Settings& settings) {
    dockNextPanel(layout, Dock::kRight);
    ImGui::Begin("Settings", nullptr, kDockedFlags);
    ImGui::PushItemWidth(160 * uiScale());
    std::string open;
    bool visible = false;
    for (const Setting& s : settings.all()) {
        if (s.info.group != open) {
            open = s.info.group;
            visible = ImGui::CollapsingHeader(open.c_str());
        }
        if (visible) editSetting(s);
    }
    ImGui::PopItemWidth();
    ImGui::End();
}

void passPanel(const PanelLayout& layout, const FrameGraph& graph) {
    static constexpr const char* kOutcomes[] = {"ran", "skipped", "dropped"};
    dockNextPanel(layout, Dock::kBottomRight);
    ImGui::Begin("Passes", nullptr, kDockedFlags);
    const auto text = [](std::string_view t) { ImGui::TextUnformatted(t.data(), t.data() + t.size()); };
    constexpr float kWidth = 760;  // pixels at scale 1: a docked panel scrolls where it has less
    if (ImGui::BeginTable("passes", 5, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit,
                          {kWidth * uiScale(), 0})) {
        ImGui::TableSetupColumn("pass");
        ImGui::TableSetupColumn("ms");
        ImGui::TableSetupColumn("");
        ImGui::TableSetupColumn("why");
        ImGui::TableSetupColumn("runs");
        ImGui::TableHeadersRow();
        for (const PassReport& pass : graph.report()) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            text(pass.name);
            ImGui::TableNextColumn();
            ImGui::Text("%.2f", pass.gpuMs);
            ImGui::TableNextColumn();
            text(kOutcomes[size_t(pass.outcome)]);
            ImGui::TableNextColumn();
            text(reasonText(pass.reason));
            if (!pass.changed.empty()) ImGui::SameLine(0, 0), text(pass.changed);
            ImGui::TableNextColumn();
            ImGui::Text("%llu", static_cast<unsigned long long>(pass.runCount));
        }
        ImGui::EndTable();
    }
    ImGui::Text("graph memory %.1f MiB", double(graph.transientBytes()) / 1048576.0);
    ImGui::End();
}

void statusPanel(const std::string& status) {
    ImGui::SetNextWindowPos({8 * uiScale(), 8 * uiScale()});
    ImGui::SetNextWindowBgAlpha(0.4f);
    ImGui::Begin("status", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::TextUnformatted(status.c_str());
    ImGui::End();
}

// GLFW's backend reads the mouse as it is when the frame begins, whatever was clicked before, and elsewhere.
void usePointer(const Pointer& pointer) {
    ImGuiIO& io = ImGui::GetIO();
    const bool inWindow = io.MousePos.x != -FLT_MAX;
    if (inWindow) io.MousePos = {pointer.place.x, pointer.place.y};
    for (uint32_t i = 0; i < std::size(io.MouseDown); ++i)
        io.MouseDown[i] = (pointer.buttons >> i & 1) != 0;
}

}  // namespace

DebugUi::DebugUi(GLFWwindow* window) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // leaves no file behind
    makeScaledFonts();
    ImGui_ImplGlfw_InitForOther(window, true);
}

PanelLayout panelLayout(const DebugUiState& state) {
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    return {.window = {window.x, window.y},
            .scale = panelScale(window.y),
            .sharesLeft = state.showProfiler,
            .sharesRight = state.showPasses};
}

bool DebugUi::holdsMouse() const {
    return ImGui::IsAnyMouseDown();
}

bool DebugUi::takesText() const {
    return ImGui::GetIO().WantTextInput;
}

DebugUi::~DebugUi() {
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void DebugUi::build(DebugUiState& state, const Pointer& pointer, Settings& settings, const FrameGraph& graph,
                    const World& world, const std::string& status, FunctionRef<void()> game) {
    history_.add(graph.spans(), double(state.profilerBudgetMs));
    ImGui_ImplGlfw_NewFrame();
    usePointer(pointer);
    useScale(panelScale(ImGui::GetIO().DisplaySize.y));
    ImGui::NewFrame();
    game();
    const PanelLayout layout = panelLayout(state);
    if (state.showStatus) statusPanel(status);
    if (state.showSettings) settingsPanel(layout, settings);
    if (state.showPasses) passPanel(layout, graph);
    if (state.showProfiler) drawProfiler(layout, history_, state.profilerBudgetMs);
    if (state.showWorld) inspector_.build(world);
    ImGui::Render();
}

}  // namespace ag
