// A RenderScene straight from an asset, for tools and tests that look at a scene without a running world.
#pragma once

#include <optional>

#include "engine/scene/scene_asset.h"

namespace ag {

struct CameraPose {
    glm::dvec3 position{0};       // m
    glm::vec3 forward{0, 0, -1};  // unit
    glm::vec3 up{0, 1, 0};     // the picture's top leans this way; need not be at right angles to `forward`
    float verticalFov = 0.8f;  // radians
    float near = 0.05f;        // m
};

// Node transforms from the root, as 4x3 matrices with a double-precision place.
struct WorldPlacement {
    glm::mat3 linear{1};
    glm::dvec3 translation{0};
};
std::vector<WorldPlacement> placeNodes(const SceneAsset& asset);

// Where someone is likely to look from: the first camera, else the first thing there is. An origin for tools.
glm::dvec3 likelyView(const SceneAsset& asset);

// Camera of the asset by index; one that frames the scene if it has none.
CameraPose cameraOf(const SceneAsset& asset, size_t index);
CameraPose framingCamera(const Bounds& bounds);

// Across the picture, unit. Who looks along `up` itself has tilted the head down or up from looking along -Z,
// as a glTF camera does.
glm::vec3 rightOf(glm::vec3 forward, glm::vec3 up);

// Instances, lights (the strongest eight bounce) and bounds, about an origin. The asset must outlive the
// result.
RenderScene staticScene(const SceneAsset& asset, glm::dvec3 originWorld = glm::dvec3(0));
// Of each of its instances the node that it stands by; -1: the world.
std::vector<int32_t> placingNodes(const SceneAsset& asset);
Bounds worldBounds(const RenderScene& scene, const RenderInstance& instance);
void setCamera(RenderScene& scene, const CameraPose& pose, glm::uvec2 size);
bool hasEmissive(const RenderScene& scene);
CameraPose poseOf(const RenderScene& scene);           // of its camera, in the world
void shiftCamera(RenderScene& scene, glm::vec3 step);  // m, without a turn

}  // namespace ag
