// How the reference's surfaces scatter light, and directions drawn from it.
#pragma once

#include "tools/reference/ray_scene.h"

namespace ag::reference {

// 1/sr, towards the viewer. Not glossy: the diffuse part alone, as Lambert.
glm::vec3 brdf(const Surface& s, glm::vec3 toViewer, glm::vec3 toLight, bool glossy);

struct DirectionSample {
    glm::vec3 direction{0};
    float density = 0;       // 1/sr
    float incident = 0;      // cosine / density; 0: the direction leads nowhere
    glm::vec3 reflected{0};  // brdf x cosine / density
};

// A cosine lobe; for glossy surfaces half the time the GGX distribution of half vectors instead, weighted by
// the density of both together. `u`, `v`, `choice`: in [0, 1).
DirectionSample sampleDirection(const Surface& s, glm::vec3 toViewer, bool glossy, float u, float v,
                                float choice);

// Of the lobes that sampleDirection draws from, 1/sr.
float densityOf(const Surface& s, glm::vec3 toViewer, glm::vec3 direction, bool glossy);

}  // namespace ag::reference
