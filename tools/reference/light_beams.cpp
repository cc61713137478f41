#include "tools/reference/light_beams.h"

#include <algorithm>
#include <cmath>

#include "common/lights.h"
#include "common/rsm_math.h"
#include "common/sampling.h"

namespace ag::reference {
namespace {

// A square view along `axis`.
struct Frame {
    glm::vec3 axis{0}, right{0}, up{0};
    explicit Frame(glm::vec3 along) : axis(along) { io::orthonormalBasis(axis, right, up); }
};

glm::vec3 faceAxis(const RenderLight& light, uint32_t face) {
    if (light.kind != LightKind::kPoint) return light.direction;
    glm::vec3 axis(0);
    axis[int(face) / 2] = face % 2 ? 1.0f : -1.0f;
    return axis;
}

float tanHalfOf(const RenderLight& light) {
    return light.kind == LightKind::kSpot ? std::tan(light.outerConeAngle) : 1;
}

// A sun's map covers the sphere about the whole scene.
struct SunMap {
    glm::vec3 center;
    float half;
    explicit SunMap(const Bounds& b)
        : center(0.5f * (b.min + b.max)), half(0.501f * glm::length(b.max - b.min)) {}
};

Beam perspectiveBeam(const RenderLight& light, const Frame& frame, glm::vec2 ndc, uint32_t resolution) {
    const float tanHalf = tanHalfOf(light);
    const glm::vec3 through = frame.axis + tanHalf * (ndc.x * frame.right + ndc.y * frame.up);
    const float cosine = 1 / glm::length(through);
    Beam beam{.origin = light.position, .direction = through * cosine};
    beam.spread = io::perspectiveTexelSolidAngle(tanHalf, float(resolution), cosine);
    float share = 1;
    if (light.kind == LightKind::kSpot)
        share = io::spotFalloff(glm::dot(beam.direction, light.direction), std::cos(light.innerConeAngle),
                                std::cos(light.outerConeAngle));
    beam.power = light.intensity * share * beam.spread;
    return beam;
}

}  // namespace

Beam beamAt(const RenderLight& light, const Bounds& scene, uint32_t face, glm::vec2 ndc,
            uint32_t resolution) {
    const Frame frame(faceAxis(light, face));
    if (light.kind != LightKind::kDirectional) return perspectiveBeam(light, frame, ndc, resolution);
    const SunMap map(scene);
    const float area = io::orthoTexelArea(2 * map.half, float(resolution));
    return {map.center + map.half * (ndc.x * frame.right + ndc.y * frame.up - 1.01f * frame.axis), frame.axis,
            light.intensity * area, area};
}

MapPlace placeOnMap(const RenderLight& light, const Bounds& scene, glm::vec3 position, uint32_t resolution) {
    MapPlace place;
    if (light.kind == LightKind::kDirectional) {
        const Frame frame(light.direction);
        const SunMap map(scene);
        const glm::vec3 d = position - map.center;
        place.ndc = glm::vec2(glm::dot(d, frame.right), glm::dot(d, frame.up)) / map.half;
        place.spread = io::orthoTexelArea(2 * map.half, float(resolution));
    } else {
        const glm::vec3 d = position - light.position, a = glm::abs(d);
        if (light.kind == LightKind::kPoint) {
            const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
            place.face = uint32_t(2 * axis + (d[axis] > 0 ? 1 : 0));
        }
        const Frame frame(faceAxis(light, place.face));
        const float along = glm::dot(d, frame.axis), tanHalf = tanHalfOf(light);
        if (!(along > 0)) return place;
        place.ndc = glm::vec2(glm::dot(d, frame.right), glm::dot(d, frame.up)) / (along * tanHalf);
        place.spread = io::perspectiveTexelSolidAngle(tanHalf, float(resolution), along / glm::length(d));
    }
    place.inside = std::abs(place.ndc.x) < 1 && std::abs(place.ndc.y) < 1;
    return place;
}

}  // namespace ag::reference
