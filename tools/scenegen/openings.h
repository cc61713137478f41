// Scenes whose light comes in by little of their surface: a window, a slit, thin walls that must keep it out.
#pragma once

#include "engine/scene/scene_asset.h"

namespace ag::scenegen {

// A closed room, 5 x 2.8 x 4 m, with one opening in a wall as thick as `depth`, through which the sun falls
// onto the floor and onto nothing else but the opening's own sides. param 1: no furniture.
SceneAsset window(uint32_t param);
// The sun's patch on the floor of `window`, W: what of its beam the opening's sides leave. A beam along d
// that goes through an opening of w x h in a wall of depth t has (w - t |dz / dx|) (h - t |dy / dx|) of it
// left.
double windowPatchPower();
// The patch's corners on the floor: least and greatest (x, z).
struct FloorPatch {
    glm::dvec2 least, most;
};
FloorPatch windowPatch();

// A hall of thin walls under a thin dome in full sun, closed on all sides: inside there is a small lamp's
// light alone. param 1: no lamp, so that any light inside is a leak.
SceneAsset shell(uint32_t param);
// A wall that the sun passes by, with sills of a few centimetres that it meets.
SceneAsset ledges(uint32_t param);
// A church's nave between columns and aisles; the sun comes in by small windows high up.
SceneAsset nave(uint32_t param);

}  // namespace ag::scenegen
