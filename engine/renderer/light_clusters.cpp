#include "engine/renderer/light_clusters.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>
#include <utility>

#include "engine/core/log.h"

namespace ag::render {
namespace {

constexpr int kBudgetRounds = 24;
constexpr float kLeastWeight = 1e-3f;  // of the mean: punctual lights that add less need no shadow

float strengthOf(const RenderLight& light) {
    return (light.intensity.x + light.intensity.y + light.intensity.z) / 3;
}

float meanStrength(const RenderScene& scene, std::span<const uint32_t> lights) {
    double sum = 0;
    for (const uint32_t light : lights)
        sum += double(strengthOf(scene.lights[light]));
    return float(sum / double(std::max<size_t>(lights.size(), 1)));
}

void takeSeenLights(const RenderScene& scene, LightClusters& out) {
    out.lights.clear();
    for (uint32_t i = 0; i < scene.lights.size(); ++i) {
        const RenderLight& light = scene.lights[i];
        if (light.kind == LightKind::kDirectional || strengthOf(light) <= 0) continue;
        const bool reaches =
            light.range <= 0 || sphereInView(scene.camera.clipFromWorld, light.position, light.range);
        if (reaches) out.lights.push_back(i);
    }
    if (out.lights.size() <= kMostPunctualLights) {
        out.leftOut = 0;
        return;
    }
    const uint32_t before = std::exchange(out.leftOut, uint32_t(out.lights.size()) - kMostPunctualLights);
    if (before == 0)
        spdlog::warn("{} lights reach into view: {} of them, the brightest from here, are lit",
                     out.lights.size(), kMostPunctualLights);
    const auto brightness = [&](uint32_t i) {
        const glm::vec3 d = scene.lights[i].position - scene.camera.position;
        return strengthOf(scene.lights[i]) / std::max(glm::dot(d, d), 1.0f);
    };
    std::ranges::nth_element(out.lights, out.lights.begin() + kMostPunctualLights, std::greater(),
                             brightness);
    out.lights.resize(kMostPunctualLights);
    std::ranges::sort(out.lights);
}

// The distance that centres keep from each light. Shadows from another place than the light's are wrong by an
// angle that shrinks with the distance to the camera, and matter as much as the light does.
void keepDistances(const RenderScene& scene, const LightClusterSettings& s, LightClusterHistory& h) {
    const LightClusters& c = h.clusters;
    const float strength = meanStrength(scene, c.lights);
    h.distances.resize(c.lights.size());
    h.weights.resize(c.lights.size());
    for (size_t i = 0; i < c.lights.size(); ++i) {
        const RenderLight& light = scene.lights[c.lights[i]];
        const std::optional<float> measured = h.relevance.of(light.id);
        h.weights[i] = !s.strongFirst ? 1
                       : measured     ? *measured / h.relevance.mean()
                                      : strengthOf(light) / strength;
        float distance = s.growth * glm::distance(light.position, scene.camera.position);
        distance *= std::clamp(1 / std::sqrt(h.weights[i]), 0.25f, 8.0f);
        if (std::ranges::binary_search(h.centers, light.id)) distance *= s.hysteresis;
        h.distances[i] = distance;
    }
}

// Centres of before come first, so that the others arrange themselves round them; then the strong ones.
void orderLights(const RenderScene& scene, const LightClusterSettings& s, LightClusterHistory& h) {
    h.order.resize(h.clusters.lights.size());
    for (uint32_t i = 0; i < h.order.size(); ++i)
        h.order[i] = i;
    const auto rank = [&](uint32_t i) {
        const RenderLight& light = scene.lights[h.clusters.lights[i]];
        const bool before = s.hysteresis < 1 && std::ranges::binary_search(h.centers, light.id);
        return std::tuple(!before, -h.weights[i], i);
    };
    std::ranges::sort(h.order, {}, rank);
}

// Whether a light takes part in clusters at all: those that add next to nothing would make one large.
bool takesPart(const RenderLight& light, float weight) {
    return light.castsShadow && weight >= kLeastWeight;
}

// First pass: in order, every light that is far enough from all centres becomes one. Returns false as soon as
// there are more than the budget.
bool chooseCenters(const RenderScene& scene, const LightClusterSettings& s, float stretch,
                   LightClusterHistory& h) {
    LightClusters& c = h.clusters;
    c.clusters.clear();
    for (const uint32_t i : h.order) {
        const RenderLight& light = scene.lights[c.lights[i]];
        if (!takesPart(light, h.weights[i])) continue;
        const float apart = stretch * h.distances[i];
        const bool alone = std::ranges::none_of(c.clusters, [&](const LightCluster& other) {
            return glm::distance(scene.lights[other.center].position, light.position) < apart;
        });
        if (!alone) continue;
        if (c.clusters.size() == s.most) return false;
        c.clusters.push_back({.center = c.lights[i]});
    }
    return true;
}

// The least stretch that keeps to the budget, from powers of two and a bisection between them.
void fitBudget(const RenderScene& scene, const LightClusterSettings& s, LightClusterHistory& h) {
    float low = 1, high = 1;
    if (chooseCenters(scene, s, 1, h)) {
        h.clusters.stretch = 1;
        return;
    }
    int rounds = 0;
    while (!chooseCenters(scene, s, high, h) && ++rounds < kBudgetRounds)
        low = high, high *= 2;
    for (; rounds < kBudgetRounds && high > 1.02f * low; ++rounds) {
        const float middle = 0.5f * (low + high);
        (chooseCenters(scene, s, middle, h) ? high : low) = middle;
    }
    chooseCenters(scene, s, high, h);
    h.clusters.stretch = high;
}

// Second pass: to the nearest centre; the lowest index settles ties.
void assignLights(const RenderScene& scene, const LightClusterSettings& s, LightClusterHistory& h) {
    LightClusters& c = h.clusters;
    c.clusterOf.assign(c.lights.size(), LightClusters::kNoCluster);
    for (size_t i = 0; i < c.lights.size(); ++i) {
        const RenderLight& light = scene.lights[c.lights[i]];
        if (!takesPart(light, h.weights[i])) continue;
        float best = std::numeric_limits<float>::max();
        uint32_t nearest = LightClusters::kNoCluster;
        for (uint32_t k = 0; k < c.clusters.size(); ++k) {
            const float distance = glm::distance(scene.lights[c.clusters[k].center].position, light.position);
            if (distance >= best) continue;
            best = distance;
            nearest = k;
        }
        const bool tooFar = s.shareWithin > 0 && light.range > 0 && best > s.shareWithin * light.range;
        if (nearest == LightClusters::kNoCluster || tooFar) continue;
        c.clusterOf[i] = nearest;
        LightCluster& cluster = c.clusters[nearest];
        cluster.radius = std::max(cluster.radius, best);
        const bool limited = light.range > 0 && (cluster.reach > 0 || cluster.lightCount == 0);
        cluster.reach = limited ? std::max(cluster.reach, best + light.range) : 0;
        ++cluster.lightCount;
    }
}

}  // namespace

bool sphereInView(const glm::mat4& clipFromWorld, glm::vec3 center, float radius) {
    const glm::mat4 t = glm::transpose(clipFromWorld);
    // left, right, bottom, top: w ± x, w ± y >= 0; in front: w >= 0 (the eye's own plane bounds the near
    // one).
    for (const glm::vec4 plane : {t[3] + t[0], t[3] - t[0], t[3] + t[1], t[3] - t[1], t[3]}) {
        const glm::vec3 normal(plane);
        if (glm::dot(normal, center) + plane.w < -radius * glm::length(normal)) return false;
    }
    return true;
}

uint32_t mostClustersNeeded(const RenderScene& scene, uint32_t most) {
    uint32_t casters = 0;
    for (const RenderLight& light : scene.lights)
        casters += light.kind != LightKind::kDirectional && light.castsShadow;
    return std::min(std::bit_ceil(casters), most);
}

const LightClusters& clusterLights(const RenderScene& scene, const PunctualRelevance& relevance,
                                   const LightClusterSettings& settings, LightClusterHistory& history) {
    if (history.lights == scene.lights && history.clipFromWorld == scene.camera.clipFromWorld &&
        history.settings == settings && history.relevance == relevance)
        return history.clusters;
    history.lights = scene.lights;
    history.clipFromWorld = scene.camera.clipFromWorld;
    history.settings = settings;
    history.relevance = relevance;
    takeSeenLights(scene, history.clusters);
    keepDistances(scene, settings, history);
    orderLights(scene, settings, history);
    fitBudget(scene, settings, history);
    assignLights(scene, settings, history);
    history.centers.clear();
    for (const LightCluster& cluster : history.clusters.clusters)
        history.centers.push_back(scene.lights[cluster.center].id);
    std::ranges::sort(history.centers);
    return history.clusters;
}

}  // namespace ag::render
