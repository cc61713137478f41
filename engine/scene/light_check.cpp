#include "engine/scene/light_check.h"

#include <cmath>

namespace ag {
namespace {

constexpr float kMostIntensity = 1e12f;  // W/sr; beyond it sums leave the range of floats

bool finite(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

const char* whyDark(const RenderLight& l) {
    if (!finite(l.position) || !finite(l.direction)) return "is nowhere: its place or direction is no number";
    if (!finite(l.intensity)) return "has an intensity that is no number";
    if (glm::any(glm::lessThan(l.intensity, glm::vec3(0)))) return "has a negative intensity";
    if (glm::any(glm::greaterThan(l.intensity, glm::vec3(kMostIntensity))))
        return "is stronger than 1e12 W/sr";
    if (std::isnan(l.range) || l.range < 0) return "has a negative range";
    const bool cone = l.innerConeAngle >= 0 && l.outerConeAngle > 0 && l.innerConeAngle <= l.outerConeAngle &&
                      l.outerConeAngle < 1.5708f;
    if (l.kind == LightKind::kSpot && !cone) return "has a cone that is none";
    return nullptr;
}

}  // namespace

const char* mendLight(RenderLight& light) {
    if (const char* why = whyDark(light)) {
        const RenderLight dark{
            .kind = LightKind::kPoint, .intensity = glm::vec3(0), .castsShadow = false, .id = light.id};
        light = dark;
        return why;
    }
    if (!std::isinf(light.range)) return nullptr;
    light.range = 0;
    return "has an infinite range: it is taken as without one";
}

}  // namespace ag
