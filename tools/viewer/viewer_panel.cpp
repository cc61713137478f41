#include "tools/viewer/viewer_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "tools/viewer/scene_panel.h"

namespace ag::viewer {
namespace {

constexpr float kDefaultIntensity = 20;  // W/sr
constexpr float kFarthest = 1e9f;        // m

void layerCombo(std::optional<render::Layer>& layer) {
    const auto nameOf = [](render::Layer l) { return std::string(render::layerInfo(l).name); };
    const std::string current = nameOf(layer.value_or(render::Layer::kFinal));
    if (!ImGui::BeginCombo("layer", current.c_str())) return;
    for (uint32_t i = 0; i < uint32_t(render::Layer::kCount); ++i) {
        const auto l = render::Layer(i);
        if (ImGui::Selectable(nameOf(l).c_str(), l == layer))
            layer = l == render::Layer::kFinal ? std::nullopt : std::optional(l);
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("%s", std::string(render::layerInfo(l).meaning).c_str());
    }
    ImGui::EndCombo();
}

// The preset from the beginning: it says only what differs from the defaults. The eye stays as it is.
void usePreset(const std::string& name, Viewing& v) {
    render::RenderSettings settings;
    if (!render::applyPreset(name, settings)) return;
    settings.exposure = v.gi.exposure;
    settings.composite = v.gi.composite;
    settings.antialiasing = v.gi.antialiasing;
    settings.bloom = v.gi.bloom;
    v.gi = settings;
    v.preset = name;
}

void antialiasingFields(render::AntialiasingSettings& s) {
    int mode = int(s.mode);
    if (ImGui::Combo("anti-aliasing", &mode, "off\0spatial\0temporal\0")) s.mode = render::Antialiasing(mode);
    float percent = 100 * s.scale;
    if (s.mode == render::Antialiasing::kTemporal &&
        ImGui::SliderFloat("rendered size", &percent, 50, 100, "%.0f %%", ImGuiSliderFlags_AlwaysClamp))
        s.scale = percent / 100;
}

// True: another one was chosen.
bool presetCombo(const char* label, std::string& preset) {
    bool chosen = false;
    if (!ImGui::BeginCombo(label, preset.c_str())) return false;
    for (const std::string_view known : render::presetNames())
        if (const std::string name(known); ImGui::Selectable(name.c_str(), name == preset))
            preset = name, chosen = true;
    ImGui::EndCombo();
    return chosen;
}

void cameraFields(FreeCamera& camera) {
    float at[3] = {float(camera.position.x), float(camera.position.y), float(camera.position.z)};
    if (ImGui::DragFloat3("eye, m", at, camera.speed * 0.01f, -kFarthest, kFarthest, "%.3f",
                          ImGuiSliderFlags_AlwaysClamp))
        camera.position = {at[0], at[1], at[2]};
    ImGui::Checkbox("orbit (O)", &camera.orbits);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(80 * uiScale());
    ImGui::DragFloat("m/s", &camera.speed, camera.speed * 0.02f, 1e-4f, 1e6f, "%.3g",
                     ImGuiSliderFlags_AlwaysClamp);
    float degrees = glm::degrees(camera.verticalFov);
    if (ImGui::SliderFloat("field of view", &degrees, 10, 120, "%.0f", ImGuiSliderFlags_AlwaysClamp))
        camera.verticalFov = glm::radians(degrees);
}

void besideFields(PanelState& state) {
    int beside = int(state.beside);
    if (ImGui::Combo("beside it", &beside, "nothing\0path tracing (T)\0a preset (B)\0"))
        state.beside = Beside(beside);
    if (state.beside == Beside::kNothing) return;
    if (state.beside == Beside::kPreset) presetCombo("the other", state.otherPreset);
    BesideSettings& s = state.besideSettings;
    bool error = s.show == BesideShown::kError;
    if (state.beside == Beside::kTruth && ImGui::Checkbox("as the error", &error))
        s.show = error ? BesideShown::kError : BesideShown::kPicture;
    if (!error || state.beside == Beside::kPreset)
        ImGui::SliderFloat("ours to here", &s.split, 0, 1, "%.2f", ImGuiSliderFlags_AlwaysClamp);
    ImGui::TextUnformatted(state.besideNumbers.c_str());
}

void overlayFields(OverlaySettings& s) {
    if (!ImGui::CollapsingHeader("drawn in the world (V)")) return;
    ImGui::Checkbox("area lights, by cluster", &s.areaLights);
    ImGui::Checkbox("views of reflective shadow maps", &s.reflectiveMaps);
    ImGui::Checkbox("views of shadow maps", &s.shadowMaps);
}

bool strengthField(RenderLight& light) {
    float strength = std::max({light.intensity.x, light.intensity.y, light.intensity.z});
    glm::vec3 color = strength > 0 ? light.intensity / strength : glm::vec3(1);
    const bool sun = light.kind == LightKind::kDirectional;
    bool changed =
        ImGui::ColorEdit3("colour", &color.x, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoInputs);
    ImGui::SameLine();
    changed |= ImGui::DragFloat(sun ? "W/m2" : "W/sr", &strength, std::max(strength, 0.01f) * 0.02f, 0, 1e9f,
                                "%.4g", ImGuiSliderFlags_AlwaysClamp);
    if (changed) light.intensity = color * strength;
    return changed;
}

// Its place and the way it shines, by dragging.
bool placeFields(RenderLight& light, float step) {
    bool changed = false;
    if (light.kind != LightKind::kDirectional)
        changed |= ImGui::DragFloat3("place, m", &light.position.x, step, -kFarthest, kFarthest, "%.3f",
                                     ImGuiSliderFlags_AlwaysClamp);
    if (light.kind == LightKind::kPoint) return changed;
    glm::vec3 direction = light.direction;
    if (ImGui::DragFloat3("direction", &direction.x, 0.01f, -1, 1) && glm::length(direction) > 1e-3f) {
        light.direction = glm::normalize(direction);
        changed = true;
    }
    return changed;
}

// Whether the light was changed, or is to go.
bool lightFields(RenderLight& light, float step, bool& remove) {
    static constexpr const char* kKinds[] = {"sun", "point", "spot"};
    bool changed = false;
    const std::string title = fmt::format("{} {}###light{}", kKinds[size_t(light.kind)], light.id, light.id);
    if (!ImGui::CollapsingHeader(title.c_str())) return false;
    ImGui::PushID(int(light.id));
    changed |= strengthField(light);
    changed |= placeFields(light, step);
    changed |= ImGui::Checkbox("bounces", &light.bounces);
    ImGui::SameLine();
    remove = ImGui::SmallButton("remove");
    ImGui::PopID();
    return changed || remove;
}

uint64_t freeId(const RenderScene& scene) {
    uint64_t id = 1;
    for (const RenderLight& light : scene.lights)
        id = std::max(id, light.id + 1);
    return id;
}

bool addButtons(Viewing& v, const FreeCamera& camera) {
    const CameraPose pose = poseOf(camera);
    RenderLight light{.kind = LightKind::kPoint,
                      .position = glm::vec3(pose.position - v.scene.originWorld),
                      .direction = pose.forward,
                      .intensity = glm::vec3(kDefaultIntensity),
                      .bounces = true,
                      .id = freeId(v.scene)};
    const bool point = ImGui::Button("lamp here"), spot = (ImGui::SameLine(), ImGui::Button("spot here")),
               sun = (ImGui::SameLine(), ImGui::Button("sun this way"));
    if (!point && !spot && !sun) return false;
    light.kind = point ? LightKind::kPoint : spot ? LightKind::kSpot : LightKind::kDirectional;
    if (sun) light.intensity = glm::vec3(10);
    v.scene.lights.push_back(light);
    return true;
}

void lightList(Viewing& v, const FreeCamera& camera) {
    bool changed = false;
    for (size_t i = 0; i < v.scene.lights.size(); ++i) {
        bool remove = false;
        changed |= lightFields(v.scene.lights[i], camera.speed * 0.01f, remove);
        if (remove) v.scene.lights.erase(v.scene.lights.begin() + std::ptrdiff_t(i--));
    }
    changed |= addButtons(v, camera);
    if (!changed) return;
    ++v.scene.lightsVersion;
    v.lightsEdited = true;
}

void windowFields(WindowWishes& wishes) {
    ImGui::Checkbox("fullscreen (F11)", &wishes.fullscreen);
    ImGui::SameLine();
    ImGui::Checkbox("vsync", &wishes.vsync);
}

// Two on a line: the panel has room for no more where the window is small.
PanelEvent eventButtons() {
    static constexpr std::pair<const char*, PanelEvent> kButtons[] = {
        {"whole scene (F)", PanelEvent::kFrameScene},
        {"picture (F12)", PanelEvent::kScreenshot},
        {"session (F5)", PanelEvent::kSaveSession},
        {"glTF (F6)", PanelEvent::kSaveScene},
        {"capture (F10)", PanelEvent::kCapture}};
    PanelEvent pressed = PanelEvent::kNone;
    bool second = false;
    for (const auto& [label, event] : kButtons) {
        if (second) ImGui::SameLine();
        second = !second;
        if (ImGui::Button(label)) pressed = event;
    }
    return pressed;
}

}  // namespace

PanelEvent drawPanel(PanelState& state, const PanelLayout& layout, Viewing& v, FreeCamera& camera,
                     const EditedScene& edited) {
    dockNextPanel(layout, Dock::kLeft);
    if (!ImGui::Begin("View", nullptr, kDockedFlags)) return ImGui::End(), PanelEvent::kNone;
    ImGui::TextUnformatted("Tab: fly or point   P: hide this");
    ImGui::PushItemWidth(140 * uiScale());
    layerCombo(state.layer);
    if (std::string preset = v.preset; presetCombo("preset", preset)) usePreset(preset, v);
    ImGui::Checkbox("automatic exposure", &v.gi.exposure.automatic);
    ImGui::SliderFloat("exposure, stops", &v.gi.composite.exposure, -10, 10, "%.1f",
                       ImGuiSliderFlags_AlwaysClamp);
    antialiasingFields(v.gi.antialiasing);
    ImGui::SliderFloat("bloom", &v.gi.bloom.share, 0, 0.5f, "%.2f", ImGuiSliderFlags_AlwaysClamp);
    besideFields(state);
    overlayFields(state.overlay);
    if (ImGui::CollapsingHeader("camera")) cameraFields(camera);
    windowFields(state.window);
    const PanelEvent pressed = eventButtons();
    lightList(v, camera);
    sceneFields(state.selection, v, edited, camera.speed * 0.01f);
    ImGui::PopItemWidth();
    if (!state.message.empty()) ImGui::TextUnformatted(state.message.c_str());
    ImGui::End();
    return pressed;
}

}  // namespace ag::viewer
