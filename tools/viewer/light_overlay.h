// The lights that the renderer makes and the maps it draws for lights, as lines over the picture: what the
// device had two frames ago.
#pragma once

#include "engine/renderer/render_frame.h"
#include "tools/viewer/world_lines.h"

namespace ag::viewer {

struct OverlaySettings {
    bool areaLights = false;      // virtual area lights in their clusters' colours
    bool reflectiveMaps = false;  // what the reflective shadow maps see
    bool shadowMaps = false;      // of suns' cascades and of lamps' clusters
    bool any() const { return areaLights || reflectiveMaps || shadowMaps; }
    bool operator==(const OverlaySettings&) const = default;
};

class LightOverlay {
  public:
    // At the end of a frame's declaration: asks for what is to be shown.
    void read(GraphScope scope, const render::SceneView& view, const render::RenderFrame& frame,
              const OverlaySettings& settings);
    // Within an ImGui frame, beneath the panels.
    void draw(const Screen& screen) const;
    size_t lineCount() const { return lines_.size(); }

  private:
    struct Drawn {
        Line line;
        uint32_t color = 0;  // ImU32
    };
    void add(const std::vector<Line>& lines, uint32_t color);
    void addAreaLights(GraphScope scope, const gi::Vals& vals);
    void addShadowMaps(GraphScope scope, const render::RenderFrame& frame, float reach);

    std::vector<Drawn> lines_;
    glm::dvec3 origin_{0};  // m
    float metres_ = 1;      // of the lines' unit
};

}  // namespace ag::viewer
