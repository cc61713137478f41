// Up to eight paths of one pixel, a step at a time, their rays traced together.
#pragma once

#include "tools/reference/direct_light.h"
#include "tools/reference/light_sources.h"
#include "tools/reference/light_sums.h"
#include "tools/reference/lit_points.h"
#include "tools/reference/random.h"

namespace ag::reference {

// Where a path begins.
struct PathStart {
    const Surface* surface = nullptr;
    glm::vec3 toViewer{0};
    glm::vec3 seenAs{1};  // by how much its radiance counts
    glm::vec2 uv{0};      // in [0, 1)², chooses the first direction
    glm::vec3 source{0};  // in [0, 1)³, chooses what shines on the first surface
    Random random;        // for all other choices
};

// What techniques without visibility of indirect light aim at: every surface along the ray counts, as if the
// ones before it were not there.
void traceThrough(const RayScene& scene, PathStart start, bool glossy, PixelSums& sums, uint64_t& rays);

// Each vertex's outgoing radiance counts at the start as irradiance and, through the first surface's brdf, as
// radiance towards the camera.
class PathLanes {
  public:
    PathLanes(const RayScene& scene, const PathSettings& settings, const LitPoints* lit);

    void begin(uint32_t lane, const PathStart& start);
    // The next paths begin at surfaces like these; none: anywhere. What they see of lit points is noted in
    // `sights`.
    void beginTile(const TileSurfaces& surfaces, double usualSum, std::span<Sight> sights, uint32_t seed);
    double tileSum() const { return tile_.sum(); }

    // To their ends; what they bring is added.
    void trace(PixelSums& sums, std::vector<LitPointWorth>& worths);
    uint64_t rays() const { return rays_; }

  private:
    struct Lane {
        const Surface* at = nullptr;
        glm::vec3 toViewer{0}, direction{0};
        glm::vec3 irradianceWeight{1}, radianceWeight{1};
        glm::vec2 uv{0};
        glm::vec3 source{0};
        float density = 0;  // of the direction, 1/sr
        Random random;
    };

    // What a lit point sends to a surface if nothing stands between.
    struct Bridge {
        uint32_t point = 0;
        glm::vec3 direction{0};
        float distance = 0;
        float geometry = 0;  // cosines / distance², of what this way of finding the light counts
    };

    float densityOfConnections(uint32_t bounce, uint32_t point) const;
    float roughlySent(uint32_t bounce, const Lane& l, glm::vec3 from, uint32_t point) const;
    Bridge bridgeTo(uint32_t bounce, const Lane& l, glm::vec3 from, uint32_t point) const;
    bool chooseBridge(uint32_t bounce, Lane& l, glm::vec3 from, Bridge& chosen, float& weight) const;
    void connect(uint32_t bounce, PixelSums& sums, std::vector<LitPointWorth>& worths);
    bool goesOn(uint32_t bounce, Lane& l, glm::vec3& reflected) const;
    void meetSources(uint32_t bounce, PixelSums& sums);
    void step(uint32_t bounce, Surface* met, PixelSums& sums);
    void findSources(uint32_t bounce, uint32_t escaped, Surface* met, PixelSums& sums) const;
    void receive(uint32_t bounce, Surface* met, PixelSums& sums);

    const RayScene& scene_;
    const PathSettings& settings_;
    const LitPoints* lit_;
    const bool emission_, sky_;  // there is such light
    TilePoints tile_, all_;
    Lane lanes_[RayLanes::kCount];
    Surface met_[2][RayLanes::kCount];  // by odd and even bounces
    uint32_t alive_ = 0;
    uint64_t rays_ = 0;
};

}  // namespace ag::reference
