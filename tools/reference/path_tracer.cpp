#include "tools/reference/path_tracer.h"

#include <atomic>
#include <cmath>
#include <numbers>

#include "common/brdf.h"
#include "common/lights.h"
#include "common/sampling.h"

namespace ag::reference {
namespace {

constexpr float kPi = std::numbers::pi_v<float>, kInvPi = std::numbers::inv_pi_v<float>;

// Rows of the lattice in parallel; each row counts its rays.
template <class F>
void forEachPixel(glm::uvec2 size, const Lattice& lattice, JobRunner& runner, uint64_t& rays, F&& pixel) {
    std::atomic<uint64_t> total{0};
    const uint32_t rows = (size.y - lattice.offset.y + lattice.step - 1) / lattice.step;
    runner.parallelFor(rows, 1, [&](uint32_t begin, uint32_t end) {
        uint64_t count = 0;
        for (uint32_t row = begin; row < end; ++row)
            for (uint32_t x = lattice.offset.x; x < size.x; x += lattice.step)
                pixel(x, lattice.offset.y + row * lattice.step, count);
        total += count;
    });
    rays += total;
}

glm::vec3 cameraDirection(const RenderCamera& camera, glm::uvec2 size, uint32_t x, uint32_t y) {
    const glm::vec2 ndc = (glm::vec2(x, y) + 0.5f) / glm::vec2(size) * 2.0f - 1.0f;
    const glm::vec4 h = camera.worldFromClip * glm::vec4(ndc, 0.5f, 1);
    return glm::normalize(glm::vec3(h) / h.w - camera.position);
}

// The first surface along a ray that a camera sees, passing single-sided ones from behind.
bool seeSurface(const RayScene& scene, glm::vec3 origin, glm::vec3 direction, Surface& surface,
                uint64_t& rays) {
    float passed = 0;
    do {
        ++rays;
        if (!scene.intersect(origin + direction * passed, direction, surface)) {
            surface.distance = 0;
            return false;
        }
        passed += surface.distance + scene.offset();
    } while (surface.hidden);
    surface.distance = glm::distance(origin, surface.position);
    scene.resolve(surface);
    return true;
}

// 1/sr, towards the viewer.
glm::vec3 brdf(const Surface& s, glm::vec3 toViewer, glm::vec3 toLight, bool glossy) {
    if (!glossy) return s.albedo * kInvPi;
    return io::metallicRoughnessBrdf(s.normal, toViewer, toLight, s.baseColor, s.metallic, s.roughness,
                                     s.specular);
}

struct Lit {
    glm::vec3 irradiance{0}, radiance{0};
};

// From every punctual light, with shadow rays. Looks the material up only where some light arrives.
Lit directLight(const RayScene& scene, Surface& surface, glm::vec3 toViewer, bool glossy, uint64_t& rays) {
    Lit sum;
    for (const PreparedLight& prepared : scene.lights()) {
        const RenderLight& light = prepared.light;
        const bool sun = light.kind == LightKind::kDirectional;
        const glm::vec3 d = light.position - surface.position;
        const float distance = sun ? 1e30f : glm::length(d);
        const glm::vec3 toLight = sun ? -light.direction : d / std::max(distance, 1e-6f);
        if (glm::dot(surface.geometricNormal, toLight) <= 0) continue;
        glm::vec3 e = light.intensity;
        if (!sun) e *= io::rangeWindow(distance, light.range) / (distance * distance);
        if (light.kind == LightKind::kSpot)
            e *= io::spotFalloff(-glm::dot(toLight, light.direction), prepared.cosInner, prepared.cosOuter);
        if (e == glm::vec3(0)) continue;
        ++rays;
        const float reach = sun ? 1e30f : distance - 2 * scene.offset();
        if (light.castsShadow && !scene.visible(leaveSurface(scene, surface), toLight, reach)) continue;
        scene.resolve(surface);
        e *= std::max(glm::dot(surface.normal, toLight), 0.0f);
        sum.irradiance += e;
        sum.radiance += e * brdf(surface, toViewer, toLight, glossy);
    }
    return sum;
}

struct Sample {
    glm::vec3 direction{0};
    float incident = 0;      // cosine / density
    glm::vec3 reflected{0};  // brdf x cosine / density
};

glm::vec3 inFrame(glm::vec3 normal, float sine, float cosine, float phi) {
    glm::vec3 t, b;
    io::orthonormalBasis(normal, t, b);
    return t * (sine * std::cos(phi)) + b * (sine * std::sin(phi)) + normal * cosine;
}

// A cosine lobe; for glossy surfaces half the time the GGX distribution of half vectors instead, weighted by
// the density of both together.
Sample sampleDirection(const Surface& s, glm::vec3 toViewer, bool glossy, float u, float v, float choice) {
    Sample out;
    const float phi = 2 * kPi * v;
    const bool coat = glossy && (s.specular > 0 || s.metallic > 0);
    if (!coat || choice < 0.5f) {
        out.direction = inFrame(s.normal, std::sqrt(u), std::sqrt(std::max(1 - u, 0.0f)), phi);
        if (!coat) {
            out.incident = kPi;
            out.reflected = s.albedo;
            return out;
        }
    }
    const float alpha = std::max(s.roughness * s.roughness, io::kLeastAlpha), a2 = alpha * alpha;
    if (choice >= 0.5f) {
        const float cosine = std::sqrt((1 - u) / (1 + (a2 - 1) * u));
        const glm::vec3 h = inFrame(s.normal, std::sqrt(std::max(1 - cosine * cosine, 0.0f)), cosine, phi);
        out.direction = glm::reflect(-toViewer, h);
    }
    const float nl = glm::dot(s.normal, out.direction);
    if (nl <= 0) return {};
    const glm::vec3 h = glm::normalize(toViewer + out.direction);
    const float nh = glm::dot(s.normal, h), vh = std::max(glm::dot(toViewer, h), 1e-6f);
    const float density = 0.5f * nl * kInvPi + 0.5f * io::ggxDistribution(nh, alpha) * nh / (4 * vh);
    out.incident = nl / density;
    out.reflected = brdf(s, toViewer, out.direction, glossy) * out.incident;
    return out;
}

struct PixelSums {
    glm::dvec3 bounces[kBouncesApart + 1] = {};
    glm::dvec3 indirect{0}, radiance{0};
    void add(uint32_t bounce, glm::vec3 irradiance, glm::vec3 reflected) {
        if (bounce <= kBouncesApart) bounces[bounce] += glm::dvec3(irradiance);
        if (bounce > 0) indirect += glm::dvec3(irradiance);
        radiance += glm::dvec3(reflected);
    }
};

// What techniques without visibility of indirect light aim at: every surface along the ray counts, as if the
// ones before it were not there.
void traceThrough(const RayScene& scene, const Surface& first, glm::vec3 toViewer, bool glossy,
                  Random& random, glm::vec2 uv, PixelSums& sums, uint64_t& rays) {
    const Sample sample = sampleDirection(first, toViewer, glossy, uv.x, uv.y, glossy ? random.next() : 0);
    if (sample.incident <= 0 || glm::dot(sample.direction, first.geometricNormal) <= 0) return;
    Surface met;
    glm::vec3 origin = leaveSurface(scene, first);
    while (++rays, scene.intersect(origin, sample.direction, met)) {
        const Lit lit = directLight(scene, met, -sample.direction, glossy, rays);
        sums.add(1, lit.radiance * sample.incident, lit.radiance * sample.reflected);
        // Far enough not to meet the same plane again when it is grazed.
        const float slant = std::abs(glm::dot(sample.direction, met.geometricNormal));
        origin = met.position + sample.direction * (scene.offset() / std::max(slant, 1e-3f));
    }
}

// One path from a surface. Each vertex's outgoing radiance counts at the start as irradiance and, through the
// first surface's brdf, as radiance towards the camera.
void tracePath(const RayScene& scene, const Surface& first, glm::vec3 toViewer, const PathSettings& settings,
               Random& random, glm::vec2 uv, PixelSums& sums, uint64_t& rays) {
    const bool looksForSources = settings.emission || settings.environment != glm::vec3(0);
    const uint32_t last = settings.bounces + (looksForSources ? 1 : 0);
    glm::vec3 irradianceWeight(1), radianceWeight(1);
    Surface met[2];
    const Surface* at = &first;
    for (uint32_t bounce = 1; bounce <= last; ++bounce) {
        if (bounce > 1) uv = {random.next(), random.next()};
        const Sample sample =
            sampleDirection(*at, toViewer, settings.glossy, uv.x, uv.y, settings.glossy ? random.next() : 0);
        if (sample.incident <= 0 || glm::dot(sample.direction, at->geometricNormal) <= 0) return;
        irradianceWeight *= bounce == 1 ? glm::vec3(sample.incident) : sample.reflected;
        radianceWeight *= sample.reflected;
        Surface& next = met[bounce % 2];
        ++rays;
        if (!scene.intersect(leaveSurface(scene, *at), sample.direction, next)) {
            sums.add(bounce - 1, irradianceWeight * settings.environment,
                     radianceWeight * settings.environment);
            return;
        }
        if (settings.emission) {
            scene.resolve(next);
            sums.add(bounce - 1, irradianceWeight * next.emissive, radianceWeight * next.emissive);
        }
        if (bounce > settings.bounces) return;
        const Lit lit = directLight(scene, next, -sample.direction, settings.glossy, rays);
        if (lit.radiance != glm::vec3(0))
            sums.add(bounce, irradianceWeight * lit.radiance, radianceWeight * lit.radiance);
        if (bounce == last) return;
        scene.resolve(next);
        at = &next;
        toViewer = -sample.direction;
    }
}

// Point number `index` of an additive recurrence in the plane (the generalised golden ratio), shifted: evenly
// spread however many are taken.
glm::vec2 evenPoint(uint32_t index, glm::uvec2 shift) {
    const glm::uvec2 fixed = index * glm::uvec2(0xc13fa9a9u, 0x91e10da5u) + shift;
    return glm::vec2(fixed >> 8u) / 16777216.0f;
}

}  // namespace

float Random::next() {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    const auto word = uint32_t((state ^ (state >> 22)) >> (22 + (state >> 61)));
    return float(word >> 8) / 16777216.0f;
}

LightSums::LightSums(glm::uvec2 size, uint32_t bounceCount)
    : bounces(std::min(bounceCount, kBouncesApart) + 1, Image(int(size.x), int(size.y))),
      indirect(int(size.x), int(size.y)),
      radiance(int(size.x), int(size.y)) {}

glm::vec3 leaveSurface(const RayScene& scene, const Surface& s) {
    return s.position + s.geometricNormal * scene.offset();
}

FirstHits::FirstHits(glm::uvec2 pixels)
    : size(pixels),
      surfaces(size_t(pixels.x) * pixels.y),
      directions(surfaces.size()),
      irradiance(int(pixels.x), int(pixels.y)),
      radiance(irradiance) {}

void traceFirstHits(const RayScene& scene, const PathSettings& settings, const Lattice& lattice,
                    JobRunner& runner, FirstHits& hits, uint64_t& rays) {
    const glm::uvec2 size = hits.size;
    const RenderCamera& camera = scene.scene().camera;
    forEachPixel(size, lattice, runner, rays, [&](uint32_t x, uint32_t y, uint64_t& count) {
        const size_t i = size_t(y) * size.x + x;
        hits.directions[i] = cameraDirection(camera, size, x, y);
        if (!seeSurface(scene, camera.position, hits.directions[i], hits.surfaces[i], count)) return;
        const Lit lit = directLight(scene, hits.surfaces[i], -hits.directions[i], settings.glossy, count);
        hits.irradiance.pixels[i] = lit.irradiance;
        hits.radiance.pixels[i] = lit.radiance;
    });
}

void addPaths(const RayScene& scene, const FirstHits& hits, const PathSettings& settings,
              const Lattice& lattice, uint32_t seed, uint32_t first, uint32_t count, JobRunner& runner,
              LightSums& sums, uint64_t& rays) {
    forEachPixel(hits.size, lattice, runner, rays, [&](uint32_t x, uint32_t y, uint64_t& rayCount) {
        const size_t i = size_t(y) * hits.size.x + x;
        if (hits.surfaces[i].distance <= 0) return;
        const uint32_t pixelKey = io::hashUint(uint32_t(i) ^ io::hashUint(seed));
        const glm::uvec2 shift(pixelKey, io::hashUint(pixelKey));
        Random random{uint64_t(pixelKey) << 32 | io::hashUint(first + seed)};
        PixelSums pixel;
        for (uint32_t s = first; s < first + count; ++s)
            if (settings.unshadowed)
                traceThrough(scene, hits.surfaces[i], -hits.directions[i], settings.glossy, random,
                             evenPoint(s, shift), pixel, rayCount);
            else
                tracePath(scene, hits.surfaces[i], -hits.directions[i], settings, random, evenPoint(s, shift),
                          pixel, rayCount);
        for (size_t b = 0; b < sums.bounces.size(); ++b)
            sums.bounces[b].pixels[i] += glm::vec3(pixel.bounces[b]);
        sums.indirect.pixels[i] += glm::vec3(pixel.indirect);
        sums.radiance.pixels[i] += glm::vec3(pixel.radiance);
    });
    if (lattice.step == 1) sums.samples += count;
}

}  // namespace ag::reference
