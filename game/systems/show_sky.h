// The sky is there where it can be seen: in rooms that are open to it and in those beside them. Elsewhere its
// light would cost time and arrive nowhere.
#pragma once

#include <memory>

#include "engine/ecs/view.h"
#include "engine/scene/render_scene.h"
#include "game/components.h"

namespace ag::game {

// Resource
struct LevelSky {
    std::shared_ptr<const Sky> sky;  // null: the level has none
    bool everywhere = false;         // wherever the player is
};

void showSky(View<const Room> rooms, Res<const Progress> progress, Res<const LevelSky> level,
             Res<RenderScene> scene);

}  // namespace ag::game
