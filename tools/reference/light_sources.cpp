#include "tools/reference/light_sources.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/scene/sky.h"

namespace ag::reference {
namespace {

constexpr glm::ivec2 kSkyCells{512, 256};
// Of the chances of sky and triangles, what does not depend on how bright they were found.
constexpr double kEvenShare = 0.05;
constexpr uint32_t kLooks = 16;  // at a textured triangle

// Even in a triangle.
glm::vec2 barycentric(float u, float v) {
    const float root = std::sqrt(u);
    return {1 - root, v * root};
}

// Mean of what a triangle shines with, at Hammersley points.
double brightnessOf(const RayScene& scene, uint32_t part, uint32_t triangle, uint32_t looks) {
    double sum = 0;
    for (uint32_t i = 0; i < looks; ++i) {
        float inverse = 0, digit = 0.5f;
        for (uint32_t bits = i; bits; bits >>= 1, digit /= 2)
            inverse += float(bits & 1) * digit;
        const glm::vec2 b = barycentric((float(i) + 0.5f) / float(looks), inverse);
        sum += double(mean(scene.emissionAt(part, triangle, b.x, b.y)));
    }
    return sum / looks;
}

// Ten bits an axis.
uint32_t mortonCode(const Bounds& bounds, glm::vec3 place) {
    const glm::vec3 unit = (place - bounds.min) / glm::max(bounds.max - bounds.min, glm::vec3(1e-20f));
    const glm::uvec3 cell(glm::clamp(unit, 0.0f, 1.0f) * 1023.0f);
    uint32_t code = 0;
    for (uint32_t bit = 0; bit < 10; ++bit)
        for (int axis = 0; axis < 3; ++axis)
            code |= (cell[axis] >> bit & 1) << (3 * bit + uint32_t(axis));
    return code;
}

// Where the sky's picture is finer than the cells, of some of what is in one.
double brightnessOfCell(const Sky& sky, glm::ivec2 cell) {
    constexpr int kSide = 4;
    double sum = 0;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const glm::vec2 at = glm::vec2(cell) + (glm::vec2(x, y) + 0.5f) / float(kSide);
            sum += double(mean(skyRadiance(sky, skyDirection(at / glm::vec2(kSkyCells)))));
        }
    return sum / (kSide * kSide);
}

std::vector<double> skyWeights(const Sky& sky) {
    std::vector<double> weights;
    double total = 0;
    for (int y = 0; y < kSkyCells.y; ++y)
        for (int x = 0; x < kSkyCells.x; ++x) {
            weights.push_back(brightnessOfCell(sky, {x, y}) * double(skyTexelAngle(kSkyCells, y)));
            total += weights.back();
        }
    if (!(total > 0)) return {};
    for (int y = 0; y < kSkyCells.y; ++y)
        for (int x = 0; x < kSkyCells.x; ++x)
            weights[size_t(y * kSkyCells.x + x)] +=
                kEvenShare * total * double(skyTexelAngle(kSkyCells, y)) / 12.566370614;
    return weights;
}

}  // namespace

Distribution::Distribution(std::vector<double> weights) : cumulative_(std::move(weights)) {
    std::partial_sum(cumulative_.begin(), cumulative_.end(), cumulative_.begin());
    total_ = cumulative_.empty() ? 0 : cumulative_.back();
}

uint32_t Distribution::draw(uint32_t first, uint32_t end, double u) const {
    const double before = first ? cumulative_[first - 1] : 0;
    const auto begin = cumulative_.begin();
    const auto at = std::upper_bound(begin + first, begin + end, before + u * sum(first, end));
    return std::min(uint32_t(at - begin), end - 1);
}

LightSources::LightSources(const RayScene& scene) : scene_(scene) {
    addEmissive();
    groupTriangles();
    if (scene.scene().sky) sky_ = Distribution(skyWeights(*scene.scene().sky));
}

void LightSources::addEmissive() {
    double area = 0, total = 0;
    for (uint32_t part = 0; part < scene_.partCount(); ++part) {
        const Material& m = scene_.materialOf(part);
        firstOfPart_.push_back(~0u);
        if (m.emissive == glm::vec3(0)) continue;
        firstOfPart_.back() = uint32_t(emissiveTriangles_.size());
        const bool textured = m.textureClass != TextureClass::kNone && m.emissiveLayer >= 0;
        for (uint32_t t = 0; t < scene_.triangleCount(part); ++t) {
            Triangle triangle{.part = part, .index = t, .area = scene_.triangleArea(part, t)};
            triangle.weight = brightnessOf(scene_, part, t, textured ? kLooks : 1) * double(triangle.area);
            triangle.center = scene_.placeOn(part, t, 1.0f / 3, 1.0f / 3, glm::vec3(0)).position;
            emissiveTriangles_.push_back(triangle);
            area += double(triangle.area), total += triangle.weight;
        }
    }
    for (Triangle& t : emissiveTriangles_)
        t.weight += area > 0 ? kEvenShare * total * double(t.area) / area : 0;
}

// In an order in which neighbours are near each other, cut where about as much has been passed.
void LightSources::groupTriangles() {
    const auto count = uint32_t(emissiveTriangles_.size());
    std::vector<uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    const Bounds& bounds = scene_.scene().bounds;
    const auto key = [&](uint32_t i) { return mortonCode(bounds, emissiveTriangles_[i].center); };
    std::ranges::stable_sort(order, {}, key);
    std::vector<Triangle> sorted;
    std::vector<double> weights;
    placeOf_.resize(count);
    double total = 0;
    for (const uint32_t i : order) {
        placeOf_[i] = uint32_t(sorted.size());
        sorted.push_back(emissiveTriangles_[i]);
        weights.push_back(sorted.back().weight);
        total += weights.back();
    }
    emissiveTriangles_ = std::move(sorted);
    double passed = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const bool few = count <= kMostGroups;
        if (few || groups_.empty() || passed >= total * double(groups_.size()) / kMostGroups)
            groups_.push_back({.first = i});
        emissiveTriangles_[i].group = uint32_t(groups_.size() - 1);
        passed += weights[i];
    }
    for (uint32_t g = 0; g < groups_.size(); ++g) {
        Group& group = groups_[g];
        const uint32_t end = g + 1 < groups_.size() ? groups_[g + 1].first : count;
        Bounds box;
        glm::vec3 first(0);
        bool alike = true;
        for (uint32_t i = group.first; i < end; ++i) {
            group.weight += float(weights[i]);
            const Triangle& t = emissiveTriangles_[i];
            const glm::vec3 normal = scene_.frontNormal(t.part, t.index);
            if (i == group.first) first = normal;
            alike = alike && glm::dot(normal, first) > 0.999f;
            for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)})
                box.add(scene_.placeOn(t.part, t.index, corner.x, corner.y, glm::vec3(0)).position);
        }
        group.center = 0.5f * (box.min + box.max);
        group.radius = 0.5f * glm::length(box.max - box.min);
        if (alike) group.normal = first;
    }
    triangles_ = Distribution(std::move(weights));
}

float LightSources::weightFrom(glm::vec3 place, const Group& group) const {
    constexpr float kBehind = 0.01f;  // shading normals may see what the plane does not
    const glm::vec3 d = place - group.center;
    const float square = glm::dot(d, d), r = std::max(group.radius, 1e-6f);
    float facing = 1;
    if (group.normal != glm::vec3(0))
        facing = std::clamp((glm::dot(group.normal, d) + r) / (std::sqrt(square) + r), kBehind, 1.0f);
    return group.weight * facing / std::max(square, r * r);
}

float LightSources::chanceOfGroup(glm::vec3 place, uint32_t group) const {
    float total = 0;
    for (const Group& g : groups_)
        total += weightFrom(place, g);
    return weightFrom(place, groups_[group]) / total;
}

SourceSample LightSources::drawEmissive(glm::vec3 from, glm::vec3 even) const {
    float cumulative[kMostGroups + 1], total = 0;
    for (size_t g = 0; g < groups_.size(); ++g)
        cumulative[g] = total += weightFrom(from, groups_[g]);
    const float at = even.x * total;
    uint32_t group = 0;
    while (group + 1 < groups_.size() && cumulative[group] <= at)
        ++group;
    const uint32_t first = groups_[group].first, end = group + 1 < groups_.size()
                                                           ? groups_[group + 1].first
                                                           : uint32_t(emissiveTriangles_.size());
    const float before = group ? cumulative[group - 1] : 0;
    const float left = std::clamp((at - before) / (cumulative[group] - before), 0.0f, 1.0f);
    const uint32_t chosen = triangles_.draw(first, end, double(left));
    const Triangle& t = emissiveTriangles_[chosen];
    const glm::vec2 b = barycentric(even.y, even.z);
    const Surface s = scene_.placeOn(t.part, t.index, b.x, b.y, from);
    SourceSample out{.direction = s.position - from, .distance = s.distance};
    out.direction /= std::max(out.distance, 1e-20f);
    if (s.hidden) return out;
    out.density = densityOn(chosen, from, s.geometricNormal, out.direction, out.distance);
    out.radiance = scene_.emissionAt(t.part, t.index, b.x, b.y);
    return out;
}

float LightSources::densityOn(uint32_t triangle, glm::vec3 from, glm::vec3 normal, glm::vec3 direction,
                              float distance) const {
    const Triangle& t = emissiveTriangles_[triangle];
    const float cosine = -glm::dot(normal, direction);
    if (!(cosine > 0) || !(t.area > 0)) return 0;
    const auto inGroup = float(t.weight / double(groups_[t.group].weight));
    return chanceOfGroup(from, t.group) * inGroup / t.area * distance * distance / cosine;
}

float LightSources::emissiveDensity(const Surface& met, glm::vec3 from, glm::vec3 direction) const {
    if (firstOfPart_[met.part] == ~0u) return 0;
    const uint32_t triangle = placeOf_[firstOfPart_[met.part] + met.triangle];
    return densityOn(triangle, from, met.geometricNormal, direction, met.distance);
}

SourceSample LightSources::drawSky(glm::vec3 even) const {
    const uint32_t chosen = sky_.draw(double(even.x));
    const glm::ivec2 cell(int(chosen) % kSkyCells.x, int(chosen) / kSkyCells.x);
    const glm::vec2 at = (glm::vec2(cell) + glm::vec2(even.y, even.z)) / glm::vec2(kSkyCells);
    SourceSample out{.direction = skyDirection(at), .distance = INFINITY};
    out.density = skyDensity(out.direction);
    out.radiance = skyRadiance(*scene_.scene().sky, out.direction);
    return out;
}

// A cell is even in both angles, not in solid angle.
float LightSources::skyDensity(glm::vec3 direction) const {
    constexpr float kTurns = 2 * 9.8696044f;  // 2 pi²: of both angles over the unit square
    const glm::vec2 place = skyPlace(direction);
    const glm::ivec2 cell = glm::min(glm::ivec2(place * glm::vec2(kSkyCells)), kSkyCells - 1);
    const float chance = float(sky_.chance(uint32_t(cell.y * kSkyCells.x + cell.x)));
    const float sine = std::sqrt(std::max(1 - direction.y * direction.y, 1e-8f));
    return chance * float(kSkyCells.x * kSkyCells.y) / (kTurns * sine);
}

}  // namespace ag::reference
