#include "tools/viewer/selection.h"

#include <algorithm>

#include "engine/app/panel_layout.h"
#include "tools/viewer/handle_style.h"
#include "tools/viewer/world_lines.h"

namespace ag::viewer {
namespace {

constexpr glm::vec2 kNowhere{-1e9f};  // pixels, of a handle that is not in sight
constexpr float kReach = 12;          // pixels at scale 1, from which the mouse takes the handle
constexpr ImU32 kBox = IM_COL32(255, 190, 60, 160), kFill = IM_COL32(255, 190, 60, 255);

glm::vec2 mousePlace() {
    return {ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y};
}

void drawBox(const Screen& screen, const Bounds& box, glm::dvec3 origin) {
    const auto corner = [&](int i) {
        const glm::vec3 p(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                          i & 4 ? box.max.z : box.min.z);
        return origin + glm::dvec3(p);
    };
    for (int i = 0; i < 8; ++i)
        for (const int axis : {1, 2, 4}) {
            if (i & axis) continue;
            if (const auto edge = projectedLine(screen, corner(i), corner(i | axis)))
                ImGui::GetBackgroundDrawList()->AddLine(toImGui(edge->from), toImGui(edge->to), kBox);
        }
}

void drawHandle(glm::vec2 at, bool held) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float half = kHandleRadius * uiScale();
    const ImVec2 from = toImGui(at - half), to = toImGui(at + half);
    list.AddRectFilled(from, to, kFill);
    list.AddRect(from, to, held ? kHandleHeld : kHandleOutline, 0, 0, 2);
}

glm::dvec3 middleOf(const Bounds& box, glm::dvec3 origin) {
    return origin + glm::dvec3((box.min + box.max) * 0.5f);
}

void select(Selection& selection, const Viewing& v, const EditedScene& edited, const Screen& screen) {
    selection = {};
    const glm::vec3 eye(screen.pose.position - v.scene.originWorld);
    const auto hit = pick(v.scene, eye, rayThrough(screen, mousePlace()));
    if (!hit) return;
    selection.thing = edited.thingOf(hit->instance);
    selection.material = v.scene.geometry->primitives[v.scene.instances[hit->instance].primitive].material;
}

}  // namespace

NodeMove& moveOf(AssetEdits& edits, uint32_t node) {
    const auto found = std::ranges::find(edits.moves, node, &NodeMove::node);
    return found != edits.moves.end() ? *found : edits.moves.emplace_back(NodeMove{.node = node});
}

MaterialLook& lookOf(AssetEdits& edits, const GeometryArrays& geometry, uint32_t material) {
    const auto found = std::ranges::find(edits.looks, material, &MaterialLook::material);
    return found != edits.looks.end() ? *found : edits.looks.emplace_back(ag::lookOf(geometry, material));
}

void dragThing(Selection& selection, Viewing& v, const EditedScene& edited, const Screen& screen) {
    const Bounds box = selection.thing ? edited.boundsOf(*selection.thing) : Bounds{};
    const glm::dvec3 middle = middleOf(box, v.scene.originWorld);
    const auto at = box.empty() ? std::nullopt : projected(screen, middle);
    // A frame's movement is before its click.
    const ImVec2 moved = ImGui::GetIO().MouseDelta;
    if (at && selection.held && (moved.x != 0 || moved.y != 0))
        moveOf(v.edits, *selection.thing).offset += draggedPlace(screen, middle, {moved.x, moved.y}) - middle;
    const bool clicked = ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !ImGui::GetIO().WantCaptureMouse;
    const glm::vec2 handle = at.value_or(kNowhere);
    const bool onHandle = glm::distance(handle, mousePlace()) < kReach * uiScale();
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) selection.held = false;
    if (clicked && !onHandle) return select(selection, v, edited, screen);
    selection.held |= clicked;
    if (!at) return;
    drawBox(screen, box, v.scene.originWorld);
    drawHandle(handle, selection.held);
}

}  // namespace ag::viewer
