// Photos in a folder of the player's.
#pragma once

#include <string>

#include "engine/renderer/debug_view.h"
#include "engine/renderer/renderer.h"

namespace ag::game {

// Of outputs of the last frame: what was shown as PNG, and `light`, the layer's values, as EXR; an invalid
// handle: there are none. Returns the files' names without their ends.
Result<std::string> savePhoto(render::Renderer& renderer, ImageHandle shown, ImageHandle light,
                              render::Layer layer, const std::string& folder);

}  // namespace ag::game
