// Lights and their maps as lines in the world.
#pragma once

#include <span>
#include <vector>

#include "shaders/direct_lighting/direct_lighting_io.h"
#include "shaders/val_fit/val_fit_io.h"
#include "tools/viewer/light_handles.h"

namespace ag::viewer {

struct Line {
    glm::vec3 from{0}, to{0};  // in the frame and unit of what they are made from
};

// The outline of a virtual area light, and its normal from the centre, half as long as the light is wide.
std::vector<Line> linesOf(const io::Val& light, const io::ValShapeVectors& shape);
// The edges of what a map with this matrix (reversed depth, perhaps without an end) covers, to `reach` m from
// the near plane at most.
std::vector<Line> edgesOfView(const glm::mat4& clipFromWorld, float reach);
// A spot's view, or the cube about the centre whose faces have the views.
std::vector<Line> edgesOfMap(const io::LightClusterRow& cluster, float reach);

struct Segment {
    glm::vec2 from{0}, to{0};  // pixels
};
// The part of a line in the world that is before the eye; none: all of it is behind.
std::optional<Segment> projectedLine(const Screen& screen, glm::dvec3 from, glm::dvec3 to);

}  // namespace ag::viewer
