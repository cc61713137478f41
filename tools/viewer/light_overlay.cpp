#include "tools/viewer/light_overlay.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "shaders/common/false_color.h"
#include "shaders/shadow_maps/shadow_maps_io.h"
#include "tools/viewer/handle_style.h"

namespace ag::viewer {
namespace {

using Copies = std::array<std::string_view, kFramesInFlight>;
constexpr Copies kVals = {"viewer.vals0", "viewer.vals1"}, kShapes = {"viewer.shapes0", "viewer.shapes1"},
                 kSuns = {"viewer.sun_views0", "viewer.sun_views1"},
                 kLamps = {"viewer.lamp_maps0", "viewer.lamp_maps1"};
constexpr ImU32 kReflective = IM_COL32(255, 240, 150, 200), kSunMap = IM_COL32(120, 200, 255, 200),
                kLampMap = IM_COL32(255, 140, 90, 200);

template <class Row>
std::vector<Row> rowsOf(std::span<const std::byte> bytes, size_t most) {
    std::vector<Row> rows(std::min(bytes.size() / sizeof(Row), most));
    if (!rows.empty()) std::memcpy(rows.data(), bytes.data(), rows.size() * sizeof(Row));
    return rows;
}

ImU32 colorOfCluster(uint32_t cluster) {
    const glm::vec3 c = io::hueFromIndex(cluster);
    return ImGui::ColorConvertFloat4ToU32({c.x, c.y, c.z, 0.9f});
}

}  // namespace

void LightOverlay::add(const std::vector<Line>& lines, uint32_t color) {
    for (const Line& line : lines)
        lines_.push_back({line, color});
}

void LightOverlay::addAreaLights(GraphScope scope, const gi::Vals& vals) {
    if (!vals.vals || !vals.shapes) return;
    const auto lights = rowsOf<io::Val>(scope.readBack(kVals, vals.vals), vals.count);
    const auto shapes = rowsOf<io::ValShapeVectors>(scope.readBack(kShapes, vals.shapes), vals.count);
    for (uint32_t i = 0; i < std::min(lights.size(), shapes.size()); ++i)
        add(linesOf(lights[i], shapes[i]), colorOfCluster(i));
}

void LightOverlay::addShadowMaps(GraphScope scope, const render::RenderFrame& frame, float reach) {
    const render::ShadowMaps& suns = frame.shadows;
    if (suns.views) {
        uint32_t count = 0;
        for (const render::SunShadow& sun : std::span(suns.suns).first(suns.sunCount))
            count = std::max(count, sun.firstView + sun.viewCount);
        for (const auto& view : rowsOf<io::ShadowView>(scope.readBack(kSuns, suns.views), count))
            add(edgesOfView(view.clipFromWorld, 4 * reach), kSunMap);
    }
    if (!frame.punctual.shadows.clusters) return;
    for (const auto& map :
         rowsOf<io::LightClusterRow>(scope.readBack(kLamps, frame.punctual.shadows.clusters), ~size_t(0)))
        if (map.size > 0) add(edgesOfMap(map, reach), kLampMap);
}

void LightOverlay::read(GraphScope scope, const render::SceneView& view, const render::RenderFrame& frame,
                        const OverlaySettings& settings) {
    lines_.clear();
    origin_ = view.scene->originWorld;
    metres_ = view.units.length;
    const float reach = view.extent / 4;
    if (settings.areaLights) addAreaLights(scope, frame.bounce.vals);
    const gi::RsmSet& rsm = frame.bounce.rsm;
    if (settings.reflectiveMaps && !rsm.empty())
        for (uint32_t i = 0; i < rsm.lightFaceCount; ++i)
            add(edgesOfView(rsm.faceInfo[i].clipFromWorld, reach), kReflective);
    if (settings.shadowMaps) addShadowMaps(scope, frame, reach);
}

void LightOverlay::draw(const Screen& screen) const {
    const auto inWorld = [&](glm::vec3 place) { return origin_ + glm::dvec3(place) * double(metres_); };
    for (const Drawn& drawn : lines_)
        if (const auto at = projectedLine(screen, inWorld(drawn.line.from), inWorld(drawn.line.to)))
            ImGui::GetBackgroundDrawList()->AddLine(toImGui(at->from), toImGui(at->to), drawn.color, 1.5f);
}

}  // namespace ag::viewer
