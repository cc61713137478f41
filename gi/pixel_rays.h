// Rays through pixels' centres: where a surface on screen is, from its depth alone.
#pragma once

#include "engine/scene/render_scene.h"
#include "shaders/common/pixel_rays.h"

namespace ag::gi {

// Of `size` pixels, or of those gathered when every `step`-th is: pixels step / 2, step + step / 2 ... along
// each side, size / step of them. One metre along the camera's axis.
io::PixelRays pixelRays(const RenderCamera& camera, glm::uvec2 size, uint32_t step = 1);

}  // namespace ag::gi
