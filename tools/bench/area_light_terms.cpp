#include "tools/bench/area_light_terms.h"

#include "common/form_factors.h"
#include "common/hemisphere_map.h"
#include "common/sampling.h"
#include "shaders/ism_atlas/ism_atlas_io.h"

namespace ag::bench {
namespace {

struct LightFrame {
    glm::vec3 t, b, n;
    explicit LightFrame(glm::vec3 normal) : n(normal) { io::orthonormalBasis(normal, t, b); }
    glm::vec3 of(glm::vec3 v) const { return {glm::dot(v, t), glm::dot(v, b), glm::dot(v, n)}; }
};

// A light's map, and the place looked for in the light's frame.
struct MapLookup {
    const glm::vec4* planes;
    int size;
    glm::vec3 d;

    MapLookup(const AreaLightSet& set, size_t light, const LightFrame& frame, glm::vec3 place)
        : planes(set.planes.data() + light * set.mapSize * set.mapSize),
          size(int(set.mapSize)),
          d(frame.of(place - eyeOf(set.lights[light]))) {}

    float shadow(glm::vec4 plane) const {
        return glm::dot(glm::vec3(plane), d) > 1 + io::kIsmHalfTexel / float(size) ? 1.0f : 0.0f;
    }
    glm::vec4 toward(glm::vec3 direction) const {
        const glm::vec2 uv = io::hemisphereEncode({direction.x, direction.y, std::max(direction.z, 0.0f)});
        const glm::ivec2 at = glm::clamp(glm::ivec2(uv * float(size)), glm::ivec2(0), glm::ivec2(size - 1));
        return planes[at.y * size + at.x];
    }
};

}  // namespace

glm::vec3 polygonIrradiance(const AreaLightRead& light, const Receiver& at) {
    const LightFrame frame(light.val.normal);
    glm::vec3 p = frame.of(at.position - light.val.position);
    glm::vec2 corners[io::kValCorners];
    std::copy(std::begin(light.shape.corners), std::end(light.shape.corners), corners);
    float below = 1;
    const float thickness = std::abs(light.val.thickness);
    if (light.val.thickness < 0)
        below = io::outsideBulge(p, corners, light.val.before, thickness, light.shape.gradient.w);
    if (thickness > 0.25f * at.width) {
        const glm::vec2 layers = io::layersBelow(p.z, thickness);
        below *= layers.x;
        p.z = layers.y;
    }
    const float factor =
        io::polygonVectorFactor(p, frame.of(at.normal), corners, light.shape.gradient, 0.25f * at.width);
    return light.val.flux * (light.shape.inversePolygon * below * factor);
}

glm::vec3 diskIrradiance(const AreaLightRead& light, const Receiver& at) {
    const io::Val& v = light.val;
    return v.flux / v.area *
           io::diskVectorFactor(at.position, at.normal, v.position, v.normal, v.area * io::kInvPi);
}

float hardMapVisibility(const AreaLightSet& set, size_t light, glm::vec3 place) {
    const MapLookup map(set, light, LightFrame(set.lights[light].val.normal), place);
    const float size = float(map.size);
    const glm::vec2 at =
        io::hemisphereEncode({map.d.x, map.d.y, std::max(map.d.z, 0.0f)}) * size - glm::vec2(0.5f);
    const glm::vec2 low = glm::clamp(glm::floor(at), glm::vec2(0), glm::vec2(size - 2)),
                    f = glm::clamp(at - low, glm::vec2(0), glm::vec2(1));
    const glm::vec4* texel = map.planes + int(low.y) * map.size + int(low.x);
    const float upper = glm::mix(map.shadow(texel[0]), map.shadow(texel[1]), f.x),
                lower = glm::mix(map.shadow(texel[map.size]), map.shadow(texel[map.size + 1]), f.x);
    return 1 - glm::mix(upper, lower, f.y);
}

float softMapVisibility(const AreaLightSet& set, size_t light, glm::vec3 place, uint32_t taps) {
    const AreaLightRead& l = set.lights[light];
    const LightFrame frame(l.val.normal);
    const MapLookup map(set, light, frame, place);
    const glm::vec2 u(frame.of(l.shape.halfU)), v(frame.of(l.shape.halfV));
    const auto from = [&](glm::vec2 s) { return glm::vec3(u * s.x + v * s.y, 0); };
    constexpr glm::vec2 kSearch[] = {{0, 0}, {0.6f, 0.6f}, {-0.6f, 0.6f}, {-0.6f, -0.6f}, {0.6f, -0.6f}};
    constexpr float kMostSpread = 0.5f;
    float blockers = 0, share = 0;
    for (const glm::vec2 s : kSearch) {
        const glm::vec4 plane = map.toward(map.d + from(s));
        blockers += map.shadow(plane);
        share += map.shadow(plane) / std::max(glm::dot(glm::vec3(plane), map.d), 1.0f);
    }
    if (blockers == 0) return 1;
    const float rho = share / blockers, spread = std::min((1 - rho) / rho, kMostSpread);
    float shadow = 0;
    for (uint32_t i = 0; i < taps; ++i) {
        const glm::vec2 s =
            glm::fract(glm::vec2(0.5f) + float(i) * glm::vec2(0.7548776662f, 0.5698402910f)) * 2.0f - 1.0f;
        shadow += map.shadow(map.toward(map.d + from(s) * spread));
    }
    return 1 - shadow / float(taps);
}

}  // namespace ag::bench
