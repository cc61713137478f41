// The level that ships with the game.
#pragma once

#include "engine/scene/gltf_import.h"

namespace ag::game {

inline SceneAsset level() {
    return *importGltf(AFTERGLOW_SOURCE_DIR "/game/level/gallery.glb");
}

}  // namespace ag::game
