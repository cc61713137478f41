#include "tools/viewer/light_dragging.h"

#include <imgui.h>

#include <algorithm>

namespace ag::viewer {
namespace {

constexpr float kRadius = 6;  // pixels
constexpr ImU32 kOutline = IM_COL32(0, 0, 0, 255), kHeld = IM_COL32(255, 255, 255, 255);

ImVec2 toImGui(glm::vec2 v) {
    return {v.x, v.y};
}

ImU32 colorOf(const RenderLight& light) {
    const float most = std::max({light.intensity.x, light.intensity.y, light.intensity.z, 1e-20f});
    const glm::vec3 c = light.intensity / most;
    return ImGui::ColorConvertFloat4ToU32({c.x, c.y, c.z, 1});
}

void drawHandle(const Screen& screen, const LightHandle& handle, ImU32 color, bool held) {
    const auto at = projected(screen, handle.place);
    if (!at) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    if (const auto anchor = projected(screen, handle.anchor); anchor && handle.aims)
        list.AddLine(toImGui(*anchor), toImGui(*at), color, 2);
    list.AddCircleFilled(toImGui(*at), kRadius, color);
    list.AddCircle(toImGui(*at), kRadius, held ? kHeld : kOutline, 0, 2);
}

// Whose handle the mouse takes now, if it is over one and not over a panel.
void takeHandle(LightDragging& state, const Screen& screen, std::span<const LightHandle> handles) {
    const ImGuiIO& io = ImGui::GetIO();
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) state.held.reset();
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !io.WantCaptureMouse)
        state.held = handleAt(screen, handles, {io.MousePos.x, io.MousePos.y});
}

}  // namespace

void dragLights(LightDragging& state, Viewing& v, const ViewCamera& camera, glm::vec2 size) {
    const Screen screen{poseOf(camera), size};
    const glm::dvec3 focus = camera.position + glm::dvec3(screen.pose.forward * camera.focusDistance),
                     origin = v.scene.originWorld;
    const std::vector<LightHandle> handles =
        lightHandles(v.scene.lights, origin, focus, camera.focusDistance / 4);
    takeHandle(state, screen, handles);
    if (state.held && *state.held >= handles.size()) state.held.reset();
    const ImVec2 moved = ImGui::GetIO().MouseDelta;
    if (state.held && (moved.x != 0 || moved.y != 0)) {
        const LightHandle& handle = handles[*state.held];
        moveHandle(handle, draggedPlace(screen, handle.place, {moved.x, moved.y}), origin,
                   v.scene.lights[handle.light]);
        ++v.scene.lightsVersion;
        v.lightsEdited = true;
    }
    for (size_t i = 0; i < handles.size(); ++i)
        drawHandle(screen, handles[i], colorOf(v.scene.lights[handles[i].light]), state.held == i);
}

}  // namespace ag::viewer
