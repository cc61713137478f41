#include "gi/surface_sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "common/sampling.h"
#include "engine/core/hash.h"
#include "gi/morton.h"

namespace ag::gi {
namespace {

struct Corners {
    std::array<glm::vec3, 3> local;
    uint8_t sharpEdges = 0;  // bit i: the surface ends or turns sharply at the edge from corner i on
    float curvature = 0;     // 1/m
};

constexpr float kFlatCosine = 0.94f;  // 20 degrees: a curvature that disks may span

std::array<glm::vec3, 3> cornersAmong(const Strided<glm::vec3>& vertices, const SampledMesh& mesh,
                                      uint32_t triangle) {
    std::array<glm::vec3, 3> corners;
    for (uint32_t i = 0; i < 3; ++i)
        corners[i] = vertices[mesh.indices[3 * triangle + i]];
    return corners;
}

uint32_t triangleCount(const SampledMesh& mesh) {
    return uint32_t(mesh.indices.size() / 3);
}

glm::vec3 faceNormal(const std::array<glm::vec3, 3>& c) {
    const glm::vec3 n = glm::cross(c[1] - c[0], c[2] - c[0]);
    const float length = glm::length(n);
    return length > 0 ? n / length : glm::vec3(0);
}

// A triangle's side, alike for both triangles that share it.
struct Side {
    uint64_t ends;  // hash of the two corners, in either order
    uint32_t triangle, index;
};

uint64_t sideOf(glm::vec3 a, glm::vec3 b) {
    const uint64_t ha = hashValue(a + 0.0f), hb = hashValue(b + 0.0f);  // -0 is 0
    return combineHash(std::min(ha, hb), std::max(ha, hb));
}

// Per triangle of a mesh, at which of its sides the surface ends or turns sharply.
std::vector<uint8_t> sharpEdges(const SampledMesh& mesh) {
    const uint32_t triangles = triangleCount(mesh);
    std::vector<Side> sides;
    sides.reserve(size_t(triangles) * 3);
    std::vector<glm::vec3> normals(triangles);
    for (uint32_t t = 0; t < triangles; ++t) {
        const auto c = cornersAmong(mesh.positions, mesh, t);
        normals[t] = faceNormal(c);
        for (uint32_t i = 0; i < 3; ++i)
            sides.push_back({sideOf(c[i], c[(i + 1) % 3]), t, i});
    }
    std::ranges::sort(sides, {}, [](const Side& s) { return std::tuple(s.ends, s.triangle, s.index); });
    std::vector<uint8_t> sharp(triangles, 0b111);
    for (size_t first = 0, end = 0; first < sides.size(); first = end) {
        for (end = first; end < sides.size() && sides[end].ends == sides[first].ends;)
            ++end;
        for (size_t i = first; i < end; ++i)
            for (size_t k = first; k < end; ++k)
                if (sides[k].triangle != sides[i].triangle &&
                    glm::dot(normals[sides[i].triangle], normals[sides[k].triangle]) > kFlatCosine)
                    sharp[sides[i].triangle] &= uint8_t(~(1u << sides[i].index));
    }
    return sharp;
}

std::array<glm::vec3, 3> worldCorners(const SampledInstance& instance,
                                      const std::array<glm::vec3, 3>& local) {
    std::array<glm::vec3, 3> world;
    for (uint32_t i = 0; i < 3; ++i)
        world[i] = instance.worldFromLocal * glm::vec4(local[i], 1);
    return world;
}

// A triangle of an instance, and where along the curve through all of them it comes.
struct CurveTriangle {
    uint32_t place;  // Morton code of its centre in the scene's box
    uint32_t instance, triangle;
    double area;    // m², in the world
    double weight;  // share of the points, relative to others'
};

constexpr uint32_t kLeastPoints =
    24;  // of an instance: small things would else be a disk larger than they are

// All that block light, movable or not, neighbours in space near each other.
std::vector<CurveTriangle> curveOf(const SampledScene& scene, bool movable) {
    std::vector<CurveTriangle> curve;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const SampledInstance& instance = scene.instances[i];
        if (!instance.isPresent || instance.movable != movable) continue;
        const SampledMesh& mesh = scene.meshes[instance.mesh];
        if (!mesh.blocksLight) continue;
        const Strided<glm::vec3>& vertices = instance.deformed ? instance.deformed : mesh.positions;
        for (uint32_t t = 0; t < triangleCount(mesh); ++t) {
            const auto w = worldCorners(instance, cornersAmong(vertices, mesh, t));
            const double area = 0.5 * double(glm::length(glm::cross(w[1] - w[0], w[2] - w[0])));
            curve.push_back({mortonCode((w[0] + w[1] + w[2]) / 3.0f, scene.bounds), i, t, area, area});
        }
    }
    std::ranges::stable_sort(curve, {}, &CurveTriangle::place);
    return curve;
}

// The most that smooth normals turn along a side of the triangle, over its length.
float curvatureOf(const SampledMesh& mesh, uint32_t triangle, const std::array<glm::vec3, 3>& corners) {
    if (!mesh.normals) return 0;
    const auto normals = cornersAmong(mesh.normals, mesh, triangle);
    float curvature = 0;
    for (uint32_t i = 0; i < 3; ++i) {
        const float length = glm::length(corners[(i + 1) % 3] - corners[i]);
        curvature =
            std::max(curvature, glm::length(normals[(i + 1) % 3] - normals[i]) / std::max(length, 1e-12f));
    }
    return curvature;
}

// The two nearest of the triangle's sharp edges.
void noteEdges(const Corners& c, io::SurfaceSample& sample) {
    for (io::SurfaceEdge& edge : sample.edgesLocal)
        edge = {glm::vec3(0), 1e30f};
    for (uint32_t i = 0; i < 3; ++i) {
        if (!(c.sharpEdges >> i & 1)) continue;
        const glm::vec3 along = c.local[(i + 1) % 3] - c.local[i];
        const glm::vec3 inward = glm::normalize(glm::cross(sample.normalLocal, along));
        const io::SurfaceEdge edge{inward, glm::dot(sample.positionLocal - c.local[i], inward)};
        if (edge.distance < sample.edgesLocal[0].distance) {
            sample.edgesLocal[1] = sample.edgesLocal[0];
            sample.edgesLocal[0] = edge;
        } else if (edge.distance < sample.edgesLocal[1].distance) {
            sample.edgesLocal[1] = edge;
        }
    }
}

// Weights of a triangle's corners that give a point on it.
glm::vec3 barycentrics(const std::array<glm::vec3, 3>& c, glm::vec3 p) {
    const glm::vec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
    const float square = std::max(glm::dot(normal, normal), 1e-30f);
    const float u = glm::dot(glm::cross(c[2] - c[1], p - c[1]), normal) / square;
    const float v = glm::dot(glm::cross(c[0] - c[2], p - c[2]), normal) / square;
    return {u, v, 1 - u - v};
}

glm::vec2 uvOn(const SampledMesh& mesh, uint32_t triangle, glm::vec3 weights) {
    glm::vec2 uv(0);
    for (uint32_t i = 0; mesh.uvs && i < 3; ++i)
        uv += weights[int(i)] * mesh.uvs[mesh.indices[3 * triangle + i]];
    return uv;
}

glm::vec3 tintOn(const SampledMesh& mesh, uint32_t triangle, glm::vec3 weights) {
    if (!mesh.colors) return glm::vec3(1);
    glm::vec3 tint(0);
    for (uint32_t i = 0; i < 3; ++i)
        tint += weights[int(i)] *
                glm::vec3(glm::unpackUnorm3x10_1x2(mesh.colors[mesh.indices[3 * triangle + i]]));
    return tint;
}

// The place at a share of a triangle's area along a curve through all of it: each digit to base 4 picks one
// of the four triangles between corners and middles of sides (Basu & Owen 2015), so that equal steps along
// the curve are spread evenly over the triangle.
glm::vec3 pointOn(const Corners& c, double share) {
    glm::vec3 p = c.local[0], q = c.local[1], r = c.local[2];
    for (int digits = 0; digits < 12; ++digits) {
        share *= 4;
        const int digit = std::clamp(int(share), 0, 3);
        share -= digit;
        const glm::vec3 pq = 0.5f * (p + q), qr = 0.5f * (q + r), rp = 0.5f * (r + p);
        if (digit == 0) p = qr, q = rp, r = pq;
        if (digit == 1) q = pq, r = rp;
        if (digit == 2) p = pq, r = qr;
        if (digit == 3) p = rp, q = qr;
    }
    return (p + q + r) / 3.0f;
}

double weightOf(const std::vector<CurveTriangle>& curve) {
    double weight = 0;
    for (const CurveTriangle& t : curve)
        weight += t.weight;
    return weight;
}

std::vector<double> areasOfInstances(const SampledScene& scene, const std::vector<CurveTriangle>& fixed,
                                     const std::vector<CurveTriangle>& movable) {
    std::vector<double> areas(scene.instances.size());
    for (const auto* curve : {&fixed, &movable})
        for (const CurveTriangle& t : *curve)
            areas[t.instance] += t.area;
    return areas;
}

// Per instance, how many times as many points it gets as by its area.
std::vector<double> densitiesOf(const std::vector<double>& areas, uint32_t count) {
    const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
    const auto instances = double(std::ranges::count_if(areas, [](double area) { return area > 0; }));
    const double least = std::min(double(kLeastPoints), count / (4 * std::max(instances, 1.0)));
    std::vector<double> densities(areas.size(), 1);
    for (size_t i = 0; i < areas.size(); ++i)
        if (areas[i] > 0) densities[i] = std::max(1.0, least * total / (areas[i] * count));
    return densities;
}

// Where it is on a triangle that joints bend, however they do.
void followJoints(const SampledScene& scene, const CurveTriangle& t, glm::vec3 weights, uint32_t sharp,
                  io::SurfaceSample& sample) {
    const SampledInstance& instance = scene.instances[t.instance];
    const uint32_t* index = &scene.meshes[instance.mesh].indices[3 * t.triangle];
    const uint32_t first = instance.firstDeformed;
    const io::SkinnedSample on{
        weights, t.instance, {first + index[0], first + index[1], first + index[2], sharp}};
    std::memcpy(&sample, &on, sizeof on);
}

// Its place on the curve is kept where the surface is cut out, so that the others stay evenly spread.
void addSample(const SampledScene& scene, const CurveTriangle& t, const Corners& c, double share,
               SurfaceSamples& out) {
    const SampledInstance& instance = scene.instances[t.instance];
    const SampledMesh& mesh = scene.meshes[instance.mesh];
    io::SurfaceSample sample{.positionLocal = pointOn(c, share),
                             .instance = t.instance,
                             .normalLocal = faceNormal(c.local),
                             .curvatureLocal = c.curvature};
    noteEdges(c, sample);
    const glm::vec3 weights = barycentrics(c.local, sample.positionLocal);
    const glm::vec2 uv = uvOn(mesh, t.triangle, weights);
    const bool hole = scene.isCutOut(instance.mesh, uv);
    if (hole) sample.edgesLocal[0] = {glm::vec3(0), -1};
    if (instance.deformed)
        followJoints(scene, t, weights, c.sharpEdges | (hole ? io::kSharpCutOut : 0), sample);
    out.samples.push_back(sample);
    out.uvs.push_back(uv);
    out.tints.push_back(tintOn(mesh, t.triangle, weights));
}

// `count` points at equal steps of all triangles' weights laid end to end.
void sampleCurve(const SampledScene& scene, const std::vector<CurveTriangle>& curve, double weight,
                 uint32_t count, SurfaceSamples& out) {
    std::unordered_map<uint32_t, std::vector<uint8_t>> sharp;  // by mesh
    const double step = weight / count;
    double before = 0;
    uint32_t taken = 0;
    for (const CurveTriangle& t : curve) {
        before += t.weight;
        if ((taken + 0.5) * step >= before && &t != &curve.back()) continue;
        const uint32_t meshIndex = scene.instances[t.instance].mesh;
        const SampledMesh& mesh = scene.meshes[meshIndex];
        auto& edges = sharp[meshIndex];
        if (edges.empty()) edges = sharpEdges(mesh);
        Corners c{cornersAmong(mesh.positions, mesh, t.triangle), edges[t.triangle]};
        c.curvature = curvatureOf(mesh, t.triangle, c.local);
        for (; taken < count && ((taken + 0.5) * step < before || &t == &curve.back()); ++taken) {
            const double share = std::clamp(1 - (before - (taken + 0.5) * step) / t.weight, 0.0, 1.0);
            addSample(scene, t, c, share, out);
        }
    }
}

}  // namespace

SurfaceSamples sampleSurfaces(const SampledScene& scene, uint32_t count) {
    std::vector<CurveTriangle> fixed = curveOf(scene, false), movable = curveOf(scene, true);
    const std::vector<double> areas = areasOfInstances(scene, fixed, movable),
                              densities = densitiesOf(areas, count);
    for (auto* curve : {&fixed, &movable})
        for (CurveTriangle& t : *curve)
            t.weight *= densities[t.instance];
    const double staticWeight = weightOf(fixed), movableWeight = weightOf(movable),
                 total = staticWeight + movableWeight;
    SurfaceSamples out;
    if (!(total > 0) || count == 0) return out;
    out.staticCount = count;
    if (movableWeight > 0) {
        const double segments = staticWeight / total * count / io::kSegmentPoints;
        out.staticCount =
            std::min(uint32_t(std::lround(segments)), (count - 1) / io::kSegmentPoints) * io::kSegmentPoints;
        if (staticWeight > 0) out.staticCount = std::max(out.staticCount, io::kSegmentPoints);
    }
    const uint32_t movableCount =
        movableWeight > 0 ? std::max(count, out.staticCount + io::kSegmentPoints) - out.staticCount : 0;
    for (size_t i = 0; i < densities.size(); ++i) {
        const double step =
            scene.instances[i].movable ? movableWeight / movableCount : staticWeight / out.staticCount;
        out.pointAreas.push_back(float(step / densities[i]));
    }
    out.samples.reserve(count);
    if (out.staticCount > 0) sampleCurve(scene, fixed, staticWeight, out.staticCount, out);
    if (movableCount > 0) sampleCurve(scene, movable, movableWeight, movableCount, out);
    return out;
}

}  // namespace ag::gi
