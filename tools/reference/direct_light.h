// Light straight from the scene's lights, for surfaces of many rays at once.
#pragma once

#include <algorithm>
#include <bit>

#include "common/lights.h"
#include "tools/reference/scattering.h"

namespace ag::reference {

// Calls body(lane) for each bit.
template <class F>
void forEachLane(uint32_t lanes, F&& body) {
    for (; lanes; lanes &= lanes - 1)
        body(uint32_t(std::countr_zero(lanes)));
}

struct Lit {
    glm::vec3 irradiance{0}, radiance{0};
};

// Irradiance on a plane that faces the light, and the way to it.
struct Arriving {
    glm::vec3 irradiance{0}, toLight{0};
    float reach = 0;  // m, of a shadow ray
};
inline Arriving arrivingFrom(const PreparedLight& prepared, const Surface& at, float offset) {
    const RenderLight& light = prepared.light;
    if (light.kind == LightKind::kDirectional) return {light.intensity, -light.direction, 1e30f};
    const glm::vec3 d = light.position - at.position;
    const float distance = glm::length(d);
    Arriving a{light.intensity, d / std::max(distance, 1e-6f), distance - 2 * offset};
    a.irradiance *= io::rangeWindow(distance, light.range) / (distance * distance);
    if (light.kind == LightKind::kSpot)
        a.irradiance *=
            io::spotFalloff(-glm::dot(a.toLight, light.direction), prepared.cosInner, prepared.cosOuter);
    return a;
}

// A point that leaves a surface without meeting it again.
inline glm::vec3 leaveSurface(const RayScene& scene, const Surface& s) {
    return s.position + s.geometricNormal * scene.offset();
}

// Surfaces that a packet of rays met; place i of each array is lane i's.
struct SurfaceLanes {
    uint32_t active = 0;  // bit i: lane i met one
    Surface* surfaces = nullptr;
    const glm::vec3* toViewer = nullptr;  // unit
    Lit* lit = nullptr;                   // light found is added
};

// From every light, with shadow rays, for the lanes' surfaces. Looks materials up only where light
// arrives. `weight(lane, light, irradiance)`: how much of it counts.
template <class F>
void directLight(const RayScene& scene, const SurfaceLanes& lanes, bool glossy, uint64_t& rayCount,
                 F&& weight) {
    for (uint32_t l = 0; l < scene.lights().size(); ++l) {
        const PreparedLight& light = scene.lights()[l];
        RayLanes shadows;
        glm::vec3 irradiance[RayLanes::kCount];
        forEachLane(lanes.active, [&](uint32_t i) {
            const Arriving a = arrivingFrom(light, lanes.surfaces[i], scene.offset());
            if (a.irradiance == glm::vec3(0) || glm::dot(lanes.surfaces[i].geometricNormal, a.toLight) <= 0)
                return;
            irradiance[i] = a.irradiance;
            shadows.set(i, leaveSurface(scene, lanes.surfaces[i]), a.toLight, a.reach);
        });
        uint32_t reached = shadows.active;
        if (light.light.castsShadow) {
            rayCount += uint64_t(std::popcount(reached));
            reached = scene.visible(shadows);
        }
        forEachLane(reached, [&](uint32_t i) {
            Surface& s = lanes.surfaces[i];
            scene.resolve(s);
            const glm::vec3 toLight = shadows.direction[i];
            const glm::vec3 all = irradiance[i] * std::max(glm::dot(s.normal, toLight), 0.0f),
                            e = all * weight(i, l, all);
            lanes.lit[i].irradiance += e;
            lanes.lit[i].radiance += e * brdf(s, lanes.toViewer[i], toLight, glossy);
        });
    }
}

inline constexpr auto kAllCounts = [](uint32_t, uint32_t, glm::vec3) { return 1.0f; };

}  // namespace ag::reference
