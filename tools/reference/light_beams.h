// The rays of a light as the texels of a square map, the same for everything that starts at lights: a spot
// and a sun have one map, a point light six.
#pragma once

#include "tools/reference/ray_scene.h"

namespace ag::reference {

struct BeamMap {
    uint32_t faces = 1;
    uint32_t resolution = 1;  // texels a side
    uint32_t texels() const { return faces * resolution * resolution; }
};

inline uint32_t faceCount(const RenderLight& light) {
    return light.kind == LightKind::kPoint ? 6 : 1;
}

// The ray through a place of a face.
struct Beam {
    glm::vec3 origin{0}, direction{0};
    glm::vec3 power{0};  // W that one texel's worth of rays around it carries, before any range window
    float spread = 0;    // of one texel about it: sr, or m² for a sun
};
// `ndc`: -1 to 1 over the face.
Beam beamAt(const RenderLight& light, const Bounds& scene, uint32_t face, glm::vec2 ndc, uint32_t resolution);

// Where on its map a light's ray to a place lies.
struct MapPlace {
    bool inside = false;
    uint32_t face = 0;
    glm::vec2 ndc{0};
    float spread = 0;  // as Beam's
};
MapPlace placeOnMap(const RenderLight& light, const Bounds& scene, glm::vec3 position, uint32_t resolution);

}  // namespace ag::reference
