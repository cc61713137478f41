// Places that shine by themselves, for rays towards them: emissive triangles, chosen by their power and how
// far they are, and the sky, chosen by its radiance.
#pragma once

#include <optional>
#include <vector>

#include "tools/reference/ray_scene.h"

namespace ag::reference {

// Numbers in proportion to weights.
class Distribution {
  public:
    explicit Distribution(std::vector<double> weights = {});
    bool empty() const { return !(total_ > 0); }
    double total() const { return total_; }
    uint32_t draw(double u) const { return draw(0, uint32_t(cumulative_.size()), u); }  // u in [0, 1)
    // Among [first, end) alone.
    uint32_t draw(uint32_t first, uint32_t end, double u) const;
    double sum(uint32_t first, uint32_t end) const {
        return cumulative_[end - 1] - (first ? cumulative_[first - 1] : 0);
    }
    double chance(uint32_t index) const {
        return (cumulative_[index] - (index ? cumulative_[index - 1] : 0)) / total_;
    }

  private:
    std::vector<double> cumulative_;
    double total_ = 0;
};

struct SourceSample {
    glm::vec3 direction{0};  // unit; density 0: there is none
    float distance = 0;      // m, INFINITY to the sky
    float density = 0;       // of the direction, 1/sr
    glm::vec3 radiance{0};   // W/(m² sr), if nothing stands between
};

class LightSources {
  public:
    explicit LightSources(const RayScene& scene);

    bool empty() const { return !anyEmissive() && !anySky(); }
    bool anyEmissive() const { return !triangles_.empty(); }
    bool anySky() const { return !sky_.empty(); }

    // `even`: in [0, 1)³.
    SourceSample drawEmissive(glm::vec3 from, glm::vec3 even) const;
    SourceSample drawSky(glm::vec3 even) const;
    // Of what a ray from `from` along `direction` met, or met nothing, had it been drawn as above; 1/sr.
    float emissiveDensity(const Surface& met, glm::vec3 from, glm::vec3 direction) const;
    float skyDensity(glm::vec3 direction) const;

  private:
    struct Triangle {
        uint32_t part = 0, index = 0;
        float area = 0;     // m²
        double weight = 0;  // about what it sends
        uint32_t group = 0;
        glm::vec3 center{0};
    };
    // Neighbours, which are about as far away as each other.
    struct Group {
        uint32_t first = 0;  // of the triangles
        float weight = 0, radius = 0;
        glm::vec3 center{0};
        glm::vec3 normal{0};  // of all its triangles, if they are alike and shine to one side; else 0
    };
    static constexpr uint32_t kMostGroups = 64;

    void addEmissive();
    void groupTriangles();
    float densityOn(uint32_t triangle, glm::vec3 from, glm::vec3 normal, glm::vec3 direction,
                    float distance) const;
    float weightFrom(glm::vec3 place, const Group& group) const;
    float chanceOfGroup(glm::vec3 place, uint32_t group) const;

    const RayScene& scene_;
    std::vector<Triangle> emissiveTriangles_;      // group by group
    std::vector<uint32_t> placeOf_, firstOfPart_;  // by part and triangle; ~0: the part does not shine
    std::vector<Group> groups_;
    Distribution triangles_;
    Distribution sky_;  // cells of kSkyCells
};

}  // namespace ag::reference
