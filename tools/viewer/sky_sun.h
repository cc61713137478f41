// The sun of a clear sky, which is turned like any other.
#pragma once

#include "tools/viewer/light_handles.h"
#include "tools/viewer/viewer.h"

namespace ag::viewer {

// None: the sky has no sun, or there is no sky. It stands for no light of the scene.
constexpr size_t kSkySun = ~size_t(0);
std::optional<LightHandle> skyHandle(const RenderScene& scene, glm::dvec3 focus, float reach);

// The sky as it is when its sun's light travels that way, which is kept downwards. Suns of the scene that
// shone the way the sky's did turn with it.
void turnSkySun(Viewing& viewing, glm::vec3 direction, float turbidity);

}  // namespace ag::viewer
