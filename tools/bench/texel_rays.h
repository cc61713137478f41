// What an area light's texels send to a place, each by itself and seen or not along a traced ray: the aim of
// polygons and shadow maps. As `--method vpl` of the reference has it, but for disks instead of points.
#pragma once

#include "tools/bench/area_light_set.h"
#include "tools/reference/path_tracer.h"

namespace ag::bench {

struct TexelSum {
    glm::vec3 irradiance{0};  // W/m², of what is seen
    float seen = 0;           // share: of what would arrive if nothing stood between
};

class TexelRays {
  public:
    // All must outlive this. `at`: a surface that was resolved.
    TexelRays(const reference::RayScene& scene, const AreaLightSet& set, const reference::Surface& at);

    // All of the light's texels.
    TexelSum all(const AreaLightRead& light);
    // `count` of them in steps of equal flux from random starts; as the mean over seeds the same irradiance.
    // Many more than a few are worth it where texels count very differently: near the light.
    TexelSum some(const AreaLightRead& light, uint32_t count, uint32_t seed);
    bool sees(glm::vec3 place);
    uint64_t rays() const { return rays_; }

  private:
    struct Lane {
        glm::vec3 irradiance;
        float weight;
    };
    void add(const io::RsmTexel& texel, glm::vec3 flux, TexelSum& sum);
    void trace(TexelSum& sum);
    TexelSum finish(TexelSum sum);

    const reference::RayScene& scene_;
    const AreaLightSet& set_;
    const reference::Surface& at_;
    glm::vec3 from_;
    reference::RayLanes lanes_;
    Lane waiting_[reference::RayLanes::kCount];
    uint32_t count_ = 0;
    float whole_ = 0;  // mean of the channels, W/m²: of the texels before the place, seen or not
    uint64_t rays_ = 0;
};

}  // namespace ag::bench
