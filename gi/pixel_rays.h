// Rays through pixels' centres: where a surface on screen is, from its depth alone.
#pragma once

#include "engine/core/render_camera.h"
#include "engine/frame/frame_graph.h"
#include "shaders/common/pixel_rays.h"

namespace ag::gi {

// One metre along the camera's axis.
io::PixelRays pixelRays(const RenderCamera& camera, glm::uvec2 size);

// io::ReprojectionCameras of images of so many pixels.
BufferHandle addReprojectionCameras(GraphScope scope, std::string_view name, const RenderCamera& now,
                                    const RenderCamera& before, glm::uvec2 size);

}  // namespace ag::gi
