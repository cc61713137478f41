#include "tools/reference/vpl_tracer.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include "common/form_factors.h"
#include "common/lights.h"
#include "common/sampling.h"
#include "tools/reference/light_beams.h"
#include "tools/reference/random.h"

namespace ag::reference {
namespace {

glm::vec3 irradianceFrom(const RayScene& scene, const Surface& at, const Emitter& emitter, uint64_t& rays) {
    const float term = io::vplTerm(at.position, at.normal, emitter.position, emitter.normal);
    if (term <= 0) return glm::vec3(0);
    const glm::vec3 from = leaveSurface(scene, at);
    const glm::vec3 d = emitter.position - from;
    const float distance = glm::length(d);
    if (glm::dot(d, at.geometricNormal) <= 0) return glm::vec3(0);
    ++rays;
    const bool seen = scene.visible(from, d / distance, distance - 2 * scene.offset());
    return seen ? emitter.flux * term : glm::vec3(0);
}

glm::dvec3 fromAll(const RayScene& scene, const Surface& at, const std::vector<Emitter>& emitters,
                   uint64_t& rays) {
    glm::dvec3 sum(0);
    for (const Emitter& emitter : emitters)
        sum += glm::dvec3(irradianceFrom(scene, at, emitter, rays));
    return sum;
}

// In steps of equal flux from a random start.
glm::dvec3 fromChosen(const RayScene& scene, const Surface& at, const std::vector<Emitter>& emitters,
                      EmitterChoice choice, uint32_t pixel, uint64_t& rays) {
    const double step = emitters.back().cumulativeFlux / choice.count;
    const double start = double(io::hashToUnit(pixel ^ io::hashUint(choice.seed)));
    glm::dvec3 sum(0);
    for (uint32_t s = 0; s < choice.count; ++s) {
        const auto chosen =
            std::ranges::lower_bound(emitters, (s + start) * step, {}, &Emitter::cumulativeFlux);
        if (chosen == emitters.end()) continue;
        sum += glm::dvec3(irradianceFrom(scene, at, *chosen, rays)) * step / double(mean(chosen->flux));
    }
    return sum;
}

}  // namespace

std::vector<Emitter> traceEmitters(const RayScene& scene, uint32_t resolution, uint32_t seed,
                                   uint64_t& rays) {
    std::vector<Emitter> emitters;
    double total = 0;
    Random random{uint64_t(io::hashUint(seed)) << 32 | seed};
    for (const RenderLight& light : scene.scene().lights) {
        for (uint32_t i = 0; i < faceCount(light) * resolution * resolution; ++i) {
            const glm::vec2 texel(i % resolution, i / resolution % resolution);
            const glm::vec2 jitter(random.next(), random.next());
            const glm::vec2 ndc = (texel + jitter) / float(resolution) * 2.0f - 1.0f;
            const Beam beam =
                beamAt(light, scene.scene().bounds, i / (resolution * resolution), ndc, resolution);
            Surface surface;
            if (mean(beam.power) <= 0) continue;
            ++rays;
            if (!scene.intersect(beam.origin, beam.direction, surface)) continue;
            scene.resolve(surface);
            // Bent normals receive by their cosine, as the path tracer has it.
            const float bend = glm::dot(surface.normal, -beam.direction) /
                               glm::dot(surface.geometricNormal, -beam.direction);
            const glm::vec3 flux = surface.albedo * beam.power * std::max(bend, 0.0f) *
                                   io::rangeWindow(surface.distance, light.range);
            if (!(mean(flux) > 0)) continue;
            total += double(mean(flux));
            emitters.push_back({surface.position, surface.geometricNormal, flux, total});
        }
    }
    return emitters;
}

void addEmitters(const RayScene& scene, const FirstHits& hits, const std::vector<Emitter>& emitters,
                 EmitterChoice choice, JobRunner& runner, LightSums& sums) {
    std::atomic<uint64_t> total{0};
    runner.parallelFor(hits.size.y, 1, [&](uint32_t begin, uint32_t end) {
        uint64_t rowRays = 0;
        for (size_t i = size_t(begin) * hits.size.x; i < size_t(end) * hits.size.x; ++i) {
            const Surface& at = hits.surfaces[i];
            if (at.distance <= 0 || emitters.empty()) continue;
            const glm::dvec3 sum = choice.count == emitters.size()
                                       ? fromAll(scene, at, emitters, rowRays)
                                       : fromChosen(scene, at, emitters, choice, uint32_t(i), rowRays);
            const glm::vec3 added = glm::vec3(sum * double(choice.count));
            sums.counts[i].paths.samples += choice.count;
            sums.bounces[1].pixels[i] += added;
            sums.indirect.pixels[i] += added;
            sums.radiance.pixels[i] += added * at.albedo * std::numbers::inv_pi_v<float>;
        }
        total += rowRays;
    });
    sums.rays += total;
}

}  // namespace ag::reference
