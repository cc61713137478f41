#include "tools/viewer/sky_sun.h"

#include <algorithm>
#include <memory>

namespace ag::viewer {
namespace {

constexpr float kLeastFall = 0.02f;    // sine of the lowest sun's height
constexpr float kSameSun = 0.999999f;  // cosine between two directions

glm::vec3 downwards(glm::vec3 direction) {
    direction.y = std::min(direction.y, -kLeastFall * glm::length(direction));
    return glm::normalize(direction);
}

}  // namespace

std::optional<LightHandle> skyHandle(const RenderScene& scene, glm::dvec3 focus, float reach) {
    if (!scene.sky || scene.sky->turbidity == 0) return std::nullopt;
    const glm::dvec3 along = glm::dvec3(scene.sky->sunDirection) * double(reach);
    return LightHandle{.light = kSkySun, .aims = true, .place = focus - along, .anchor = focus};
}

void turnSkySun(Viewing& v, glm::vec3 direction, float turbidity) {
    if (glm::length(direction) < 1e-6f) return;
    direction = downwards(direction);
    const glm::vec3 before = v.scene.sky->sunDirection;
    for (RenderLight& light : v.scene.lights) {
        if (light.kind != LightKind::kDirectional || glm::dot(light.direction, before) < kSameSun) continue;
        light.direction = direction;
        v.lightsEdited = true;
        ++v.scene.lightsVersion;
    }
    v.scene.sky = std::make_shared<const Sky>(analyticSky(direction, turbidity));
    v.skyEdited = true;
}

}  // namespace ag::viewer
