#include "tools/viewer/scene_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "tools/viewer/sky_sun.h"

namespace ag::viewer {
namespace {

constexpr float kFarthestMove = 1e7f;  // m
constexpr float kBrightest = 1e6f;     // W/(m² sr)
constexpr auto kClamped = ImGuiSliderFlags_AlwaysClamp;

void thingFields(AssetEdits& edits, const EditedScene& edited, uint32_t node, float step) {
    ImGui::Text("thing: %s", edited.nameOf(node).c_str());
    const auto known = std::ranges::find(edits.moves, node, &NodeMove::node);
    glm::vec3 offset = known == edits.moves.end() ? glm::vec3(0) : glm::vec3(known->offset);
    if (ImGui::DragFloat3("moved by, m", &offset.x, step, -kFarthestMove, kFarthestMove, "%.3f", kClamped))
        moveOf(edits, node).offset = offset;
    if (offset == glm::vec3(0)) return;
    ImGui::SameLine();
    if (ImGui::SmallButton("back##thing")) moveOf(edits, node).offset = glm::dvec3(0);
}

// A colour with its greatest channel at 1, times a strength, as lights have it.
bool emissionField(glm::vec3& emissive) {
    float strength = std::max({emissive.x, emissive.y, emissive.z});
    glm::vec3 color = strength > 0 ? emissive / strength : glm::vec3(1);
    bool changed =
        ImGui::ColorEdit3("##shines", &color.x, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoInputs);
    ImGui::SameLine();
    changed |= ImGui::DragFloat("shines, W/m2sr", &strength, std::max(strength, 0.1f) * 0.02f, 0, kBrightest,
                                "%.4g", kClamped);
    if (changed) emissive = color * strength;
    return changed;
}

void materialFields(AssetEdits& edits, const GeometryArrays& geometry, uint32_t material) {
    const std::string& name = geometry.materials[material].name;
    ImGui::Text("material: %s", name.empty() ? fmt::format("{}", material).c_str() : name.c_str());
    MaterialLook look = ag::lookOf(geometry, material);
    bool changed = ImGui::ColorEdit3("base colour", &look.baseColor.x, ImGuiColorEditFlags_Float);
    changed |= ImGui::SliderFloat("metallic", &look.metallic, 0, 1, "%.2f", kClamped);
    changed |= ImGui::SliderFloat("roughness", &look.roughness, 0, 1, "%.2f", kClamped);
    changed |= emissionField(look.emissive);
    look.baseColor = glm::clamp(look.baseColor, 0.0f, 1.0f);
    if (changed) lookOf(edits, geometry, material) = look;
}

void skyFields(Viewing& v) {
    if (!ImGui::CollapsingHeader("the sky's sun")) return;
    glm::vec3 direction = v.scene.sky->sunDirection;
    float turbidity = v.scene.sky->turbidity;
    bool changed = ImGui::DragFloat3("its way##sky", &direction.x, 0.01f, -1, 1);
    changed |= ImGui::SliderFloat("turbidity", &turbidity, kLeastTurbidity, kMostTurbidity, "%.1f", kClamped);
    if (changed) turnSkySun(v, direction, turbidity);
}

}  // namespace

void sceneFields(Selection& selection, Viewing& v, const EditedScene& edited, float step) {
    if (v.scene.sky && v.scene.sky->turbidity > 0) skyFields(v);
    if (!selection.thing && !selection.material) {
        ImGui::TextDisabled("click a thing to move or change it");
        return;
    }
    if (selection.thing) thingFields(v.edits, edited, *selection.thing, step);
    if (selection.material) materialFields(v.edits, *v.scene.geometry, *selection.material);
}

}  // namespace ag::viewer
