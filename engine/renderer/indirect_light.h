// The scene handed over to gi/, and the choice among its recipes.
#pragma once

#include "engine/renderer/render_frame.h"

namespace ag::render {

// Whether histories of pixels' light follow what moves. `sky`: the scene has one.
bool needsMotion(const RenderSettings& settings, bool sky);

gi::BounceLight addIndirectLight(GraphScope scope, const SceneView& scene, const gi::Surfaces& surfaces,
                                 const RenderSettings& settings, RenderHistory& history);

// What gi/ knows of the scene; valid as long as the lists are left alone.
gi::Occluders occludersOf(const SceneView& scene);
gi::Versions versionsOf(const SceneView& scene);
gi::World worldOf(const SceneView& scene, WorldLists& lists);

}  // namespace ag::render
