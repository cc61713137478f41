#include "gi/surface_sampling.h"

#include <algorithm>
#include <cmath>

#include "common/sampling.h"

namespace ag::gi {
namespace {

struct Corners {
    glm::vec3 local[3];
    double area = 0;  // m², in the world
};

Corners cornersOf(const RenderScene& scene, const RenderInstance& instance, uint32_t triangle) {
    const GeometryArrays& g = *scene.geometry;
    const Primitive& p = g.primitives[instance.primitive];
    Corners c;
    glm::vec3 world[3];
    for (uint32_t i = 0; i < 3; ++i) {
        const uint32_t index = g.indices[p.firstIndex + 3 * triangle + i];
        c.local[i] = g.positions[size_t(int64_t(p.vertexOffset) + index)];
        world[i] = instance.worldFromLocal * glm::vec4(c.local[i], 1);
    }
    c.area = 0.5 * double(glm::length(glm::cross(world[1] - world[0], world[2] - world[0])));
    return c;
}

template <class F>
void forEachTriangle(const RenderScene& scene, F&& visit) {
    const GeometryArrays& g = *scene.geometry;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Primitive& p = g.primitives[scene.instances[i].primitive];
        if (g.materials[p.material].alphaMode == AlphaMode::kBlend) continue;
        for (uint32_t t = 0; t < p.indexCount / 3; ++t)
            visit(i, cornersOf(scene, scene.instances[i], t));
    }
}

// Number `index` of an additive recurrence, folded onto the triangle.
glm::vec3 pointOn(const Corners& c, uint32_t index) {
    const glm::uvec2 fixed = index * glm::uvec2(0xc13fa9a9u, 0x91e10da5u);
    glm::vec2 uv = glm::vec2(fixed >> 8u) / 16777216.0f;
    if (uv.x + uv.y > 1) uv = 1.0f - uv;
    return c.local[0] * (1 - uv.x - uv.y) + c.local[1] * uv.x + c.local[2] * uv.y;
}

void shuffle(std::vector<io::SurfaceSample>& samples) {
    for (uint32_t i = uint32_t(samples.size()); i > 1; --i)
        std::swap(samples[i - 1], samples[io::hashUint(i) % i]);
}

}  // namespace

SurfaceSamples sampleSurfaces(const RenderScene& scene, uint32_t count) {
    double total = 0;
    forEachTriangle(scene, [&](uint32_t, const Corners& c) { total += c.area; });
    SurfaceSamples out{.area = float(total)};
    if (!(total > 0) || count == 0) return out;
    out.samples.reserve(count + 1);
    // Equal steps along all triangles' area laid end to end.
    const double step = total / count;
    double before = 0, next = 0.5 * step;
    forEachTriangle(scene, [&](uint32_t instance, const Corners& c) {
        const glm::vec3 normal = glm::cross(c.local[1] - c.local[0], c.local[2] - c.local[0]);
        for (before += c.area; next < before; next += step)
            out.samples.push_back({.positionLocal = pointOn(c, uint32_t(out.samples.size())),
                                   .instance = instance,
                                   .normalLocal = glm::normalize(normal)});
    });
    shuffle(out.samples);
    return out;
}

}  // namespace ag::gi
