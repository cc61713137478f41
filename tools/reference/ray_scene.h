// The renderer's own scene for rays: the same triangles, textures, lights and camera, in Embree.
#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <memory>
#include <vector>

#include "engine/scene/deform.h"

namespace ag::reference {

inline float mean(glm::vec3 v) {
    return (v.x + v.y + v.z) / 3;
}

struct Surface {                         // what a ray met
    glm::vec3 position{0};               // m
    float distance = 0;                  // m, 0: nothing was met
    glm::vec3 geometricNormal{0, 1, 0};  // unit, on the ray's side
    uint32_t part = 0, triangle = 0;     // with u, v: the place on it
    float u = 0, v = 0;
    bool hidden =
        false;  // a single-sided surface from behind: blocks light, reflects none, no camera sees it

    // From here on valid after RayScene::resolve.
    bool resolved = false;
    glm::vec3 normal{0, 1, 0};  // shading, bent by the normal map, unit
    glm::vec3 albedo{0};        // diffuse
    glm::vec3 baseColor{0};
    float metallic = 0, roughness = 1, specular = 0;
    glm::vec3 emissive{0};  // W/(m² sr)
};

// How a surface blends with what is behind it.
struct Veil {
    glm::vec3 transmitted{1};  // of the light from behind
    float coverage = 0;        // of the surface's own
};

// What a pixel covers of the surface at its centre: how far its neighbours' rays land to the right and below,
// m. Zero: a point.
struct Footprint {
    glm::vec3 right{0}, down{0};
};

struct UvArea;  // ray_surfaces.cpp

// A light with what every ray to it would work out again.
struct PreparedLight {
    RenderLight light;
    float cosInner = 0, cosOuter = 0;
};

// Rays traced together: as many as a CPU's vectors are wide. Those of one place, or towards one, are traced
// faster so.
struct RayLanes {
    static constexpr uint32_t kCount = 8;
    glm::vec3 origin[kCount], direction[kCount];  // directions are unit
    float reach[kCount];                          // m
    uint32_t active = 0;                          // a bit a lane

    void set(uint32_t lane, glm::vec3 from, glm::vec3 along, float distance) {
        origin[lane] = from, direction[lane] = along, reach[lane] = distance;
        active |= 1u << lane;
    }
};

class LightSources;

class RayScene {
  public:
    // The scene and its geometry must outlive this. Alpha-masked holes let rays through; blended surfaces are
    // there for intersectBlended() alone.
    explicit RayScene(const RenderScene& scene);
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    // The nearest surface along a unit direction, its material not yet looked up; false if there is none.
    bool intersect(glm::vec3 origin, glm::vec3 direction, Surface& surface) const;
    // Looks up shading normal and material: most surfaces on a path are in the dark and never need them.
    // Textures are averaged over the footprint, without one read at a point.
    void resolve(Surface& surface, const Footprint& over = {}) const;
    // Whether nothing stands between origin and origin + direction x distance.
    bool visible(glm::vec3 origin, glm::vec3 direction, float distance) const;
    // The same for many at once; bits of the lanes that met a surface, or nothing.
    uint32_t intersect(const RayLanes& rays, Surface* surfaces) const;
    uint32_t visible(const RayLanes& rays) const;

    bool hasBlended() const { return parts_.size() > opaqueParts_; }
    bool intersectBlended(glm::vec3 origin, glm::vec3 direction, Surface& surface) const;
    // Of a blended surface; resolves it, without what of its albedo is transmitted instead.
    Veil veilOf(Surface& surface, glm::vec3 direction, bool glossy) const;

    // Of the triangles: parts are instances that rays meet. `from`: the side it is seen from.
    uint32_t partCount() const { return opaqueParts_; }
    uint32_t triangleCount(uint32_t part) const { return parts_[part]->primitive->indexCount / 3; }
    const Material& materialOf(uint32_t part) const;
    // Unit; zero where it has two sides or no area.
    glm::vec3 frontNormal(uint32_t part, uint32_t triangle) const;
    float triangleArea(uint32_t part, uint32_t triangle) const;  // m²
    glm::vec3 emissionAt(uint32_t part, uint32_t triangle, float u, float v) const;
    Surface placeOn(uint32_t part, uint32_t triangle, float u, float v, glm::vec3 from) const;

    const RenderScene& scene() const { return scene_; }
    const std::vector<PreparedLight>& lights() const { return lights_; }
    const LightSources& sources() const { return *sources_; }
    // How far to step off a surface, m: a small part of the scene's size and of the position's precision.
    float offset() const { return offset_; }
    glm::vec3 skyAlong(glm::vec3 direction) const {  // radiance of the sky, W/(m² sr)
        return scene_.sky ? skyRadiance(*scene_.sky, direction) : glm::vec3(0);
    }
    RTCScene embree() const { return rtc_; }

  private:
    struct Part {  // one Embree geometry: an instance
        const RenderInstance* instance;
        const Primitive* primitive;
        VertexPointers vertices;  // by the primitive's indices
        glm::mat3 worldFromLocal, normalFromLocal;
        bool mirrored, doubleSided;
    };
    void addPart(RTCScene rtc, const RenderInstance& instance);
    bool intersectIn(RTCScene rtc, glm::vec3 origin, glm::vec3 direction, Surface& surface) const;
    void takeHit(glm::vec3 origin, glm::vec3 direction, float distance, glm::vec3 normal, uint32_t part,
                 Surface& s) const;
    std::array<glm::vec3, 3> cornersOf(const Part& part, uint32_t triangle) const;
    glm::vec2 uvAt(const Part& part, uint32_t triangle, float u, float v) const;
    UvArea uvOver(const Part& part, const Surface& s, const Footprint& over) const;
    glm::vec3 colorAt(const Part& part, uint32_t triangle, float u, float v) const;
    glm::vec3 shadingNormal(const Part& part, const Surface& s, const UvArea& uv) const;
    float alphaAt(const Part& part, uint32_t triangle, float u, float v) const;
    bool masked(const Part& part, uint32_t triangle, float u, float v) const;
    static void filterMasked(const RTCFilterFunctionNArguments* arguments);

    const RenderScene& scene_;
    const DeformedVertices deformed_;
    RTCDevice device_ = nullptr;
    RTCScene rtc_ = nullptr, blended_ = nullptr;
    std::vector<std::unique_ptr<Part>> parts_;  // by geometry id; blended ones come last
    uint32_t opaqueParts_ = 0;
    std::vector<PreparedLight> lights_;
    std::unique_ptr<LightSources> sources_;
    float offset_ = 1e-4f;
};

}  // namespace ag::reference
