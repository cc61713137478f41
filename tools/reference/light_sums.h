// What paths brought to the pixels of a picture, and how much it varied.
#pragma once

#include <string_view>
#include <vector>

#include "engine/core/image.h"
#include "tools/reference/direct_light.h"
#include "tools/reference/path_settings.h"

namespace ag::reference {

enum class Shining { kSurface, kSky };  // what sends light of its own beside suns and lamps

// Of the paths of one pixel. Irradiance on the shading normal, before albedo, W/m²; radiance towards the
// camera, W/(m² sr).
struct PixelSums {
    glm::dvec3 bounces[kBouncesApart + 1] = {};  // [n]: light of suns and lamps after n bounces; [0] stays 0
    glm::dvec3 emissive{0}, sky{0};              // straight from there
    glm::dvec3 indirect{0}, radiance{0};         // all bounced light; all
    void add(uint32_t bounce, glm::vec3 irradiance, glm::vec3 reflected) {
        if (bounce <= kBouncesApart) bounces[bounce] += glm::dvec3(irradiance);
        if (bounce > 0) indirect += glm::dvec3(irradiance);
        radiance += glm::dvec3(reflected);
    }
    void addFrom(Shining source, uint32_t bounce, glm::vec3 irradiance, glm::vec3 reflected) {
        if (bounce > 0)
            indirect += glm::dvec3(irradiance);
        else if (source == Shining::kSky)
            sky += glm::dvec3(irradiance);
        else
            emissive += glm::dvec3(irradiance);
        radiance += glm::dvec3(reflected);
    }
};

// The layer whose noise counts: what paths and direct light bring to it.
class MeasuredLayer {
  public:
    MeasuredLayer() = default;  // radiance
    explicit MeasuredLayer(std::string_view name);
    glm::vec3 ofPaths(const PixelSums& sums) const;
    glm::vec3 ofDirect(const Lit& lit) const;

  private:
    enum class Kind { kRadiance, kIrradiance, kIndirect, kBounce, kEmissive, kSky } kind_ = Kind::kRadiance;
    uint32_t bounce_ = 0;
};

// Samples of a pixel, which come in packets of up to eight.
struct SampleCount {
    uint32_t samples = 0, packets = 0;
    float packetSquares = 0;  // of the packets' means of the measured layer
    void add(uint32_t count, glm::vec3 measuredMean) {
        samples += count, packets += 1;
        packetSquares += glm::dot(measuredMean, measuredMean);
    }
};
// Places are what camera rays look at for direct light, where a filter asks for more than the pixel's centre.
struct PixelCount {
    SampleCount paths, places;
};

// Sums over each pixel's paths, and direct light over its places. At pixel centres direct light is FirstHits'
// and not in here.
struct LightSums {
    LightSums(glm::uvec2 size, uint32_t bounces, MeasuredLayer measured = {});

    std::vector<Image> bounces;  // as PixelSums'
    Image emissive, sky;
    Image indirect;
    Image radiance;  // towards the camera, without direct light of suns and lamps
    Image directIrradiance, directRadiance;
    std::vector<PixelCount> counts;
    MeasuredLayer measured;
    uint64_t rays = 0;

    // Of those that have any.
    double meanPaths() const;
};

}  // namespace ag::reference
