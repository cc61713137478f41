// Handles in the picture by which lights are dragged: where a lamp is, where a spot points, where a sun comes
// from.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/scene/static_scene.h"

namespace ag::viewer {

// The picture that handles lie in.
struct Screen {
    CameraPose pose;
    glm::vec2 size{1};  // pixels
};

// Pixels from the top left; none: behind the eye.
std::optional<glm::vec2> projected(const Screen& screen, glm::dvec3 place);
// The place moved in the plane parallel to the picture, by so many pixels.
glm::dvec3 draggedPlace(const Screen& screen, glm::dvec3 place, glm::vec2 pixels);

struct LightHandle {
    size_t light = 0;  // index
    bool aims = false;
    glm::dvec3 place{0};   // m, in the world
    glm::dvec3 anchor{0};  // where the line to it begins; of a lamp's place: itself
};

// `focus`: a point ahead, about which the handles of suns lie at `reach` m; spots point `reach` m far.
std::vector<LightHandle> lightHandles(std::span<const RenderLight> lights, glm::dvec3 origin,
                                      glm::dvec3 focus, float reach);
// The nearest within twelve pixels.
std::optional<size_t> handleAt(const Screen& screen, std::span<const LightHandle> handles, glm::vec2 pixel);
// The handle's light once it was dragged to `place`.
void moveHandle(const LightHandle& handle, glm::dvec3 place, glm::dvec3 origin, RenderLight& light);

}  // namespace ag::viewer
