// The truth of a scene: all layers of one camera image, with their noise.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "engine/core/function_ref.h"
#include "engine/core/result.h"
#include "tools/reference/path_tracer.h"

namespace ag::reference {

enum class Method : uint32_t { kPaths, kEmitters };

struct ReferenceSettings {
    PathSettings paths;
    Method method = Method::kPaths;  // kEmitters: first bounce by the texels of RSMs
    uint32_t samplesPerPixel = 64;   // at most: paths, or emitters met
    double maxError = 0;             // stop when the layer's noise is below; 0: take all samples
    uint32_t seed = 1;
    uint32_t emitterMap = 128;  // texels along an RSM's side
    std::string layer = "radiance";
};

// The same, and for radiance surfaces that blend with what is behind them are seen, where the scene has such.
ReferenceSettings withBlended(const RayScene& scene, ReferenceSettings settings);

struct Reference {
    // Irradiance in W/m² before albedo, [n] of suns and lamps by exactly n bounces, `indirect` all that
    // bounced; radiance in W/(m² sr); depth in m along the camera's axis.
    std::vector<Image> bounces;
    Image emissive, sky;  // straight from emissive surfaces and from the sky
    Image indirect, irradiance, radiance, albedo, normal, depth;
    double noise = 0;      // relative RMSE of the layer that was asked for, from two seeds
    uint32_t samples = 0;  // taken a pixel
    uint64_t rays = 0;
};

// radiance, irradiance, direct, emissive, sky, bounce1 … bounce8, indirect (or bounces), albedo, normal,
// depth. Null: no such layer.
const Image* layerOf(const Reference& reference, std::string_view name);
// Fails with a sentence when a layer's name is unknown or has more bounces than are traced.
Status checkLayer(std::string_view name, uint32_t bounces);

// A reference that gets better as long as it is asked to: two halves of the picture, independent of each
// other.
class Refinement {
  public:
    // All must outlive this. Traces what the camera sees, and where light is worth looking for.
    Refinement(const RayScene& scene, glm::uvec2 size, const ReferenceSettings& settings, JobRunner& runner);
    ~Refinement();
    Refinement(const Refinement&) = delete;
    Refinement& operator=(const Refinement&) = delete;

    // `count` samples more for each half of the pixels that are due, eight at most. False: nothing is there.
    bool add(uint32_t count);
    double samplesOfHalf() const;  // a pixel, in the mean
    Reference half(uint32_t index) const;
    Reference mean() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// `progress` is called now and then with the share that is done.
Reference makeReference(const RayScene& scene, glm::uvec2 size, const ReferenceSettings& settings,
                        JobRunner& runner, FunctionRef<void(double)> progress);

// The best pictures of the indirect light (layers bounce1, indirect, radiance) that path tracing has after so
// many seconds, ascending: pixels are visited in a spread order, those not reached take their neighbour's
// value. `seen` takes a picture's own time, a little over what was asked; what it does is not counted.
void traceOverTime(const RayScene& scene, glm::uvec2 size, const PathSettings& settings,
                   std::span<const double> seconds, JobRunner& runner,
                   FunctionRef<void(double, const Reference&)> seen);

// Relative RMSE of the mean of two independent estimates of equal worth, from their difference.
double noiseOf(const Image& a, const Image& b);

}  // namespace ag::reference
