#include "tools/reference/ray_speed.h"

#include <atomic>
#include <chrono>
#include <cmath>

#include "common/sampling.h"
#include "tools/reference/random.h"

namespace ag::reference {
namespace {

struct BareRay {
    glm::vec3 origin, direction;
    float reach;
    bool shadow;
};

void addShadowRays(const RayScene& scene, const Surface& at, std::vector<BareRay>& rays) {
    for (const RenderLight& light : scene.scene().lights) {
        const glm::vec3 d = light.position - at.position;
        const float distance = glm::length(d);
        const bool sun = light.kind == LightKind::kDirectional;
        const glm::vec3 toLight = sun ? -light.direction : d / distance;
        if (glm::dot(toLight, at.geometricNormal) <= 0) continue;
        rays.push_back({leaveSurface(scene, at), toLight, sun ? 1e30f : distance - 2 * scene.offset(), true});
    }
}

constexpr int kPathsPerPixel = 8;

std::vector<BareRay> layOut(const RayScene& scene, const FirstHits& hits) {
    std::vector<BareRay> rays;
    Random random{7};
    for (const Surface& at : hits.surfaces) {
        if (at.distance <= 0) continue;
        glm::vec3 t, b;
        io::orthonormalBasis(at.normal, t, b);
        for (int path = 0; path < kPathsPerPixel; ++path) {
            const float r = std::sqrt(random.next()), phi = 6.2831853f * random.next();
            const glm::vec3 direction =
                t * (r * std::cos(phi)) + b * (r * std::sin(phi)) + at.normal * std::sqrt(1 - r * r);
            rays.push_back({leaveSurface(scene, at), direction, INFINITY, false});
            Surface next;
            if (scene.intersect(rays.back().origin, direction, next)) addShadowRays(scene, next, rays);
        }
    }
    return rays;
}

void shoot(RTCScene scene, const BareRay& r) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray{};
    ray.ray = {r.origin.x, r.origin.y, r.origin.z, 0, r.direction.x, r.direction.y, r.direction.z, 0,
               r.reach,    ~0u,        0,          0};
    if (r.shadow) {
        rtcOccluded1(scene, &context, &ray.ray);
    } else {
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene, &context, &ray);
    }
}

}  // namespace

double bareRaysPerSecond(const RayScene& scene, glm::uvec2 size, JobRunner& runner) {
    using Clock = std::chrono::steady_clock;
    uint64_t ignored = 0;
    FirstHits hits(size);
    traceFirstHits(scene, {}, {}, runner, hits, ignored);
    const std::vector<BareRay> rays = layOut(scene, hits);
    double best = 0;
    for (int repeat = 0; repeat < 3; ++repeat) {
        const auto start = Clock::now();
        runner.parallelFor(uint32_t(rays.size()), 4096, [&](uint32_t begin, uint32_t end) {
            for (uint32_t i = begin; i < end; ++i)
                shoot(scene.embree(), rays[i]);
        });
        const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
        best = std::max(best, double(rays.size()) / seconds);
    }
    return best;
}

}  // namespace ag::reference
