// Rooms of the gallery that have a file of their own.
#pragma once

#include "tools/scenegen/gallery_parts.h"

namespace ag::scenegen {

void greenhouse(SceneBuilder& b, Furnisher& f);
void garden(SceneBuilder& b, Furnisher& f);

}  // namespace ag::scenegen
