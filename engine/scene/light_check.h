// Lights as anybody may make them, made fit to render.
#pragma once

#include "engine/scene/render_scene.h"

namespace ag {

// Null if nothing is wrong with a light, else what is, in a few words that follow its name. Then it has been
// mended: an infinite range is none, and a light with numbers that mean nothing sends none.
const char* mendLight(RenderLight& light);

}  // namespace ag
