#include "tools/viewer/light_dragging.h"

#include <algorithm>

#include "engine/app/panel_layout.h"
#include "tools/viewer/handle_style.h"
#include "tools/viewer/sky_sun.h"

namespace ag::viewer {
namespace {

constexpr float kSkyReach = 1.5f;  // of the lights' handles: the two suns' lie apart
constexpr ImU32 kSky = IM_COL32(140, 190, 255, 255);

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
    list.AddCircleFilled(toImGui(*at), kHandleRadius * uiScale(), color);
    list.AddCircle(toImGui(*at), kHandleRadius * uiScale(), held ? kHandleHeld : kHandleOutline, 0, 2);
}

// Whose handle the mouse takes now, if it is over one and not over a panel.
void takeHandle(LightDragging& state, const Screen& screen, std::span<const LightHandle> handles) {
    const ImGuiIO& io = ImGui::GetIO();
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) state.held.reset();
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !io.WantCaptureMouse)
        state.held = handleAt(screen, handles, {io.MousePos.x, io.MousePos.y});
}

void dragHandle(Viewing& v, const LightHandle& handle, glm::dvec3 place) {
    if (handle.light == kSkySun)
        return turnSkySun(v, glm::vec3(handle.anchor - place), v.scene.sky->turbidity);
    moveHandle(handle, place, v.scene.originWorld, v.scene.lights[handle.light]);
    ++v.scene.lightsVersion;
    v.lightsEdited = true;
}

}  // namespace

bool dragLights(LightDragging& state, Viewing& v, const FreeCamera& camera, glm::vec2 size) {
    const Screen screen{poseOf(camera), size};
    const glm::dvec3 focus = camera.position + glm::dvec3(screen.pose.forward * camera.focusDistance);
    const float reach = camera.focusDistance / 4;
    std::vector<LightHandle> handles = lightHandles(v.scene.lights, v.scene.originWorld, focus, reach);
    if (const auto sky = skyHandle(v.scene, focus, kSkyReach * reach)) handles.push_back(*sky);
    if (state.held && *state.held >= handles.size()) state.held.reset();
    const ImVec2 moved = ImGui::GetIO().MouseDelta;
    if (state.held && (moved.x != 0 || moved.y != 0)) {
        const LightHandle& handle = handles[*state.held];
        dragHandle(v, handle, draggedPlace(screen, handle.place, {moved.x, moved.y}));
    }
    takeHandle(state, screen, handles);  // after the movement, which is before the click
    for (size_t i = 0; i < handles.size(); ++i)
        drawHandle(screen, handles[i],
                   handles[i].light == kSkySun ? kSky : colorOf(v.scene.lights[handles[i].light]),
                   state.held == i);
    return state.held.has_value();
}

}  // namespace ag::viewer
