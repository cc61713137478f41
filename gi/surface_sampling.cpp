#include "gi/surface_sampling.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <tuple>
#include <unordered_map>

#include "common/sampling.h"
#include "engine/core/hash.h"

namespace ag::gi {
namespace {

struct Corners {
    glm::vec3 local[3];
    uint8_t sharpEdges = 0;  // bit i: the surface ends or bends at the edge from corner i on
    double area = 0;         // m², in the world
};

constexpr float kFlatCosine = 0.94f;  // 20 degrees: a bend that disks may span

std::array<glm::vec3, 3> localCorners(const GeometryArrays& g, const Primitive& p, uint32_t triangle) {
    std::array<glm::vec3, 3> corners;
    for (uint32_t i = 0; i < 3; ++i)
        corners[i] =
            g.positions[size_t(int64_t(p.vertexOffset) + g.indices[p.firstIndex + 3 * triangle + i])];
    return corners;
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

// Per triangle of a primitive, at which of its sides the surface ends or bends.
std::vector<uint8_t> sharpEdges(const GeometryArrays& g, const Primitive& p) {
    const uint32_t triangles = p.indexCount / 3;
    std::vector<Side> sides;
    sides.reserve(size_t(triangles) * 3);
    std::vector<glm::vec3> normals(triangles);
    for (uint32_t t = 0; t < triangles; ++t) {
        const auto c = localCorners(g, p, t);
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

Corners cornersOf(const RenderScene& scene, const RenderInstance& instance, uint32_t triangle) {
    const GeometryArrays& g = *scene.geometry;
    const Primitive& p = g.primitives[instance.primitive];
    Corners c;
    glm::vec3 world[3];
    const auto local = localCorners(g, p, triangle);
    for (uint32_t i = 0; i < 3; ++i) {
        c.local[i] = local[i];
        world[i] = instance.worldFromLocal * glm::vec4(c.local[i], 1);
    }
    c.area = 0.5 * double(glm::length(glm::cross(world[1] - world[0], world[2] - world[0])));
    return c;
}

template <class F>
void forEachTriangle(const RenderScene& scene, F&& visit) {
    const GeometryArrays& g = *scene.geometry;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Primitive& p = g.primitives[scene.instances[i].primitive];
        if (g.materials[p.material].alphaMode == AlphaMode::kBlend) continue;
        for (uint32_t t = 0; t < p.indexCount / 3; ++t) {
            Corners c = cornersOf(scene, scene.instances[i], t);
            visit(i, t, c);
        }
    }
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

// By mirrored bits of their places along the surfaces: neighbours in the order are far apart, and any run of
// them is spread evenly.
std::vector<io::SurfaceSample> interleaved(const std::vector<io::SurfaceSample>& samples) {
    const uint32_t count = uint32_t(samples.size()), bits = uint32_t(std::bit_width(count - 1));
    std::vector<io::SurfaceSample> out;
    out.reserve(count);
    for (uint32_t i = 0; i < 1u << bits; ++i) {
        const uint32_t mirrored = uint32_t(double(io::radicalInverse2(i)) * (1u << bits));
        if (mirrored < count) out.push_back(samples[mirrored]);
    }
    return out;
}

}  // namespace

SurfaceSamples sampleSurfaces(const RenderScene& scene, uint32_t count) {
    double total = 0;
    forEachTriangle(scene, [&](uint32_t, uint32_t, const Corners& c) { total += c.area; });
    SurfaceSamples out{.area = float(total)};
    if (!(total > 0) || count == 0) return out;
    out.samples.reserve(count + 1);
    std::unordered_map<uint32_t, std::vector<uint8_t>> sharp;  // by primitive
    // Equal steps along all triangles' area laid end to end.
    const double step = total / count;
    double before = 0, next = 0.5 * step;
    forEachTriangle(scene, [&](uint32_t instance, uint32_t triangle, Corners& c) {
        before += c.area;
        if (next >= before) return;
        const uint32_t primitive = scene.instances[instance].primitive;
        auto& edges = sharp[primitive];
        if (edges.empty()) edges = sharpEdges(*scene.geometry, scene.geometry->primitives[primitive]);
        c.sharpEdges = edges[triangle];
        for (; next < before; next += step) {
            io::SurfaceSample sample{.positionLocal = pointOn(c, 1 - (before - next) / c.area),
                                     .instance = instance,
                                     .normalLocal = faceNormal({c.local[0], c.local[1], c.local[2]})};
            noteEdges(c, sample);
            out.samples.push_back(sample);
        }
    });
    out.samples = interleaved(out.samples);
    return out;
}

}  // namespace ag::gi
