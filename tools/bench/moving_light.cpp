#include "tools/bench/moving_light.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace ag::bench {
namespace {

constexpr uint32_t kKeys = 5;

}  // namespace

std::vector<RenderLight> movedLights(const RenderScene& scene, double time) {
    std::vector<RenderLight> lights = scene.lights;
    const float diagonal = glm::length(scene.bounds.max - scene.bounds.min);
    const glm::quat turn = glm::angleAxis(glm::radians(4.0f * float(time)), glm::vec3(0, 1, 0)) *
                           glm::angleAxis(glm::radians(2.0f * float(time)), glm::vec3(1, 0, 0));
    for (RenderLight& light : lights) {
        if (light.kind == LightKind::kPoint)
            light.position.x += 0.01f * diagonal * float(time);
        else
            light.direction = glm::normalize(turn * light.direction);
    }
    return lights;
}

Result<ReferenceTrend> ReferenceTrend::make(ReferenceCache& cache, RenderScene scene, glm::uvec2 size,
                                            reference::ReferenceSettings settings, JobRunner& runner,
                                            FunctionRef<void(double)> progress) {
    ReferenceTrend trend;
    // Paths of one seed alone err alike from key to key, which no deviation over time sees; what is learned
    // of each key's light would make them differ.
    settings.paths.litPoints = false;
    const RenderScene still = scene;
    for (uint32_t key = 0; key < kKeys; ++key) {
        scene.lights = movedLights(still, double(key) / (kKeys - 1));
        const auto part = [&](double share) { progress((key + share) / kKeys); };
        auto image = cache.get(scene, size, settings, runner, part);
        if (!image) return image.error();
        trend.keys_.push_back(std::move(*image));
    }
    return trend;
}

// Lagrange's polynomial through the keys.
Image ReferenceTrend::at(double time) const {
    Image out(keys_[0].width, keys_[0].height);
    for (size_t k = 0; k < keys_.size(); ++k) {
        double weight = 1;
        for (size_t j = 0; j < keys_.size(); ++j)
            if (j != k) weight *= (time * (kKeys - 1) - double(j)) / (double(k) - double(j));
        for (size_t i = 0; i < out.pixels.size(); ++i)
            out.pixels[i] += float(weight) * keys_[k].pixels[i];
    }
    return out;
}

double flickerOf(const std::vector<Image>& frames, const ReferenceTrend* trend) {
    const size_t pixels = frames[0].pixels.size();
    std::vector<double> sum(pixels, 0), squares(pixels, 0);
    double mean = 0;
    for (size_t f = 0; f < frames.size(); ++f) {
        const Image truth = trend ? trend->at(double(f) / double(frames.size() - 1)) : Image();
        for (size_t i = 0; i < pixels; ++i) {
            const glm::vec3 p = frames[f].pixels[i];
            double value = double(p.x + p.y + p.z) / 3;
            mean += value / double(pixels * frames.size());
            if (trend) value -= double(truth.pixels[i].x + truth.pixels[i].y + truth.pixels[i].z) / 3;
            sum[i] += value;
            squares[i] += value * value;
        }
    }
    double deviation = 0;
    const double n = double(frames.size());
    for (size_t i = 0; i < pixels; ++i)
        deviation += std::sqrt(std::max(squares[i] / n - sum[i] * sum[i] / (n * n), 0.0)) / double(pixels);
    return mean > 0 ? deviation / mean : 0;
}

}  // namespace ag::bench
