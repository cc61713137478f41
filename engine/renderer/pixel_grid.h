// Which places of the picture are rendered in a frame.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "engine/core/render_camera.h"

namespace ag::render {

struct PixelGrid {
    glm::uvec2 size{0};    // rendered
    glm::uvec2 output{0};  // shown
    glm::vec2 jitter{0};   // from a rendered pixel's centre to where it is sampled, rendered pixels
    uint64_t step = 0;     // goes on while the jitter does
    uint64_t version = 0;  // of all that the picture depends on but the jitter
};

// The camera that sees from the pixels' centres what `camera` sees where they are sampled.
RenderCamera jittered(const RenderCamera& camera, const PixelGrid& grid);
// Of that camera.
uint64_t jitteredVersion(uint64_t cameraVersion, const PixelGrid& grid);

}  // namespace ag::render
