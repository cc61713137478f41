#include "tools/reference/path_tracer.h"

#include <atomic>
#include <cmath>
#include <numbers>

#include "common/lights.h"
#include "common/sampling.h"

namespace ag::reference {
namespace {

// A permuted congruential generator: one stream a pixel.
struct Random {
    uint64_t state;
    float next() {
        state = state * 6364136223846793005ull + 1442695040888963407ull;
        const auto word = uint32_t((state ^ (state >> 22)) >> (22 + (state >> 61)));
        return float(word >> 8) / 16777216.0f;
    }
};

glm::vec3 cosineDirection(glm::vec3 normal, float u, float v) {
    const float r = std::sqrt(u), phi = 2 * std::numbers::pi_v<float> * v;
    glm::vec3 t, b;
    io::orthonormalBasis(normal, t, b);
    return glm::normalize(t * (r * std::cos(phi)) + b * (r * std::sin(phi)) +
                          normal * std::sqrt(std::max(1 - u, 0.0f)));
}

glm::vec3 leave(const RayScene& scene, const Surface& s) {
    return s.position + s.geometricNormal * scene.offset();
}

struct PixelSums {
    glm::dvec3 bounce1{0}, indirect{0};
};

// One path from a surface: each bounce's irradiance at the start, as the mean of albedo x irradiance along
// cosine-chosen directions (the cosine and 1/pi cancel).
void tracePath(const RayScene& scene, Surface at, uint32_t bounces, Random& random, float u, float v,
               PixelSums& sums, uint64_t& rays) {
    glm::vec3 weight(1);
    for (uint32_t bounce = 1; bounce <= bounces; ++bounce) {
        const glm::vec3 direction =
            cosineDirection(at.normal, bounce == 1 ? u : random.next(), bounce == 1 ? v : random.next());
        if (glm::dot(direction, at.geometricNormal) <= 0) return;
        Surface next;
        ++rays;
        if (!scene.intersect(leave(scene, at), direction, next)) return;
        const glm::vec3 arrived = weight * next.albedo * directIrradiance(scene, next, rays);
        if (bounce == 1) sums.bounce1 += glm::dvec3(arrived);
        sums.indirect += glm::dvec3(arrived);
        weight *= next.albedo;
        at = next;
    }
}

glm::vec3 cameraDirection(const RenderCamera& camera, glm::uvec2 size, uint32_t x, uint32_t y) {
    const glm::vec2 ndc = (glm::vec2(x, y) + 0.5f) / glm::vec2(size) * 2.0f - 1.0f;
    const glm::vec4 h = camera.worldFromClip * glm::vec4(ndc, 0.5f, 1);
    return glm::normalize(glm::vec3(h) / h.w - camera.position);
}

}  // namespace

glm::vec3 directIrradiance(const RayScene& scene, const Surface& surface, uint64_t& rays) {
    glm::vec3 sum(0);
    for (const RenderLight& light : scene.scene().lights) {
        const bool sun = light.kind == LightKind::kDirectional;
        const glm::vec3 d = light.position - surface.position;
        const float distance = sun ? 1e30f : glm::length(d);
        const glm::vec3 toLight = sun ? -light.direction : d / std::max(distance, 1e-6f);
        const float cosine = glm::dot(surface.normal, toLight);
        if (cosine <= 0 || glm::dot(surface.geometricNormal, toLight) <= 0) continue;
        glm::vec3 e = light.intensity * cosine;
        if (!sun) e *= io::rangeWindow(distance, light.range) / (distance * distance);
        if (light.kind == LightKind::kSpot)
            e *= io::spotFalloff(-glm::dot(toLight, light.direction), std::cos(light.innerConeAngle),
                                 std::cos(light.outerConeAngle));
        if (e == glm::vec3(0)) continue;
        ++rays;
        if (scene.visible(leave(scene, surface), toLight, sun ? 1e30f : distance - 2 * scene.offset()))
            sum += e;
    }
    return sum;
}

Image ReferenceImages::irradiance() const {
    Image out = direct;
    for (size_t i = 0; i < out.pixels.size(); ++i)
        out.pixels[i] += indirect.pixels[i];
    return out;
}

Image ReferenceImages::radiance() const {
    Image out = irradiance();
    for (size_t i = 0; i < out.pixels.size(); ++i)
        out.pixels[i] = out.pixels[i] * albedo.pixels[i] * std::numbers::inv_pi_v<float> + emissive.pixels[i];
    return out;
}

ReferenceImages tracePaths(const RayScene& scene, glm::uvec2 size, const PathSettings& settings,
                           JobRunner& runner, FunctionRef<void(double)> progress) {
    ReferenceImages out;
    for (Image* image :
         {&out.direct, &out.bounce1, &out.indirect, &out.albedo, &out.normal, &out.depth, &out.emissive})
        *image = Image(int(size.x), int(size.y));
    std::atomic<uint64_t> rays{0};
    std::atomic<uint32_t> rowsDone{0};
    const RenderCamera& camera = scene.scene().camera;
    const uint32_t samples = settings.bounces == 0 ? 0 : settings.samplesPerPixel;
    runner.parallelFor(size.y, 1, [&](uint32_t begin, uint32_t end) {
        for (uint32_t y = begin; y < end; ++y) {
            uint64_t rowRays = 0;
            for (uint32_t x = 0; x < size.x; ++x) {
                Surface first;
                ++rowRays;
                const glm::vec3 direction = cameraDirection(camera, size, x, y);
                if (!scene.intersect(camera.position, direction, first)) continue;
                const size_t pixel = size_t(y) * size.x + x;
                out.direct.pixels[pixel] = directIrradiance(scene, first, rowRays);
                out.albedo.pixels[pixel] = first.albedo;
                out.normal.pixels[pixel] = first.normal;
                out.depth.pixels[pixel] = glm::vec3(first.distance * glm::dot(direction, camera.forward));
                out.emissive.pixels[pixel] = first.emissive;
                // A Hammersley set shifted at random covers the first bounce evenly.
                const auto key = io::hashUint(uint32_t(pixel) ^ io::hashUint(settings.seed));
                Random random{uint64_t(key) << 32 | settings.seed};
                const glm::vec2 shift(random.next(), random.next());
                PixelSums sums;
                for (uint32_t s = 0; s < samples; ++s) {
                    const glm::vec2 at = glm::fract(io::hammersley(s, samples) + shift);
                    tracePath(scene, first, settings.bounces, random, at.x, at.y, sums, rowRays);
                }
                if (samples == 0) continue;
                out.bounce1.pixels[pixel] = glm::vec3(sums.bounce1 / double(samples));
                out.indirect.pixels[pixel] = glm::vec3(sums.indirect / double(samples));
            }
            rays += rowRays;
            progress(double(++rowsDone) / size.y);
        }
    });
    out.rays = rays;
    return out;
}

}  // namespace ag::reference
