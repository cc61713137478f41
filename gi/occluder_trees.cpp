#include "gi/occluder_trees.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "common/sampling.h"
#include "gi/bvh.h"

namespace ag::gi {
namespace {

constexpr uint32_t kLeafTriangles = 4;
constexpr size_t kMostSorted = 512;  // movers whose tree is worth building well in every frame

struct Triangle {
    std::array<glm::vec3, 3> corners;
    float opacity = 0;  // share that an alpha mask leaves
    SentAt sent;        // mean
    io::BvhMask mask{};
    float front = 0;  // as io::frontOf
};

Bounds boundsOf(const Triangle& t) {
    Bounds b;
    for (const glm::vec3 c : t.corners)
        b.add(c);
    return b;
}

// Grid coordinates of a box: its longest side takes all steps, so that the grid is as fine along each axis.
struct Grid {
    glm::vec3 origin;
    float stepsPerMetre;

    explicit Grid(const Bounds& b) : origin(b.min) {
        const glm::vec3 size = b.max - b.min;
        const float longest = std::max({size.x, size.y, size.z});
        // Two steps less: boxes are rounded outwards.
        stepsPerMetre = longest > 0 ? (io::kBvhGrid - 2) / longest : 1;
    }
    glm::vec3 operator()(glm::vec3 p) const { return (p - origin) * stepsPerMetre + 1.0f; }
    // Rows of the grid's coordinates from those of the world.
    void place(const glm::mat4x3& localFromWorld, io::BvhPlace& p) const {
        const glm::mat3x4 rows = glm::transpose(localFromWorld);
        const auto row = [&](int i) {
            glm::vec4 r = rows[i] * stepsPerMetre;
            r.w += 1 - origin[i] * stepsPerMetre;
            return r;
        };
        p.gridFromWorld0 = row(0), p.gridFromWorld1 = row(1), p.gridFromWorld2 = row(2);
    }
};

// Rounded outwards, so that rounding never hides what is inside. Coordinates are above 0, where to cut off is
// to round down.
glm::uvec4 packed(const BvhNode& node, const Grid& grid, uint32_t firstNode, uint32_t firstItem) {
    const glm::uvec3 low(glm::clamp(grid(node.bounds.min), 0.0f, io::kBvhGrid));
    const glm::uvec3 high(glm::clamp(grid(node.bounds.max) + 1.0f, 0.0f, io::kBvhGrid));
    const uint32_t link = node.count > 0
                              ? io::kBvhLeafBit | node.count << io::kBvhCountShift | (firstItem + node.first)
                              : firstNode + node.next;
    return {low.x | low.y << 16, low.z | high.x << 16, high.y | high.z << 16, link};
}

TreeRange append(OccluderTrees& trees, const std::vector<Triangle>& triangles) {
    std::vector<Bounds> boxes;
    boxes.reserve(triangles.size());
    for (const Triangle& t : triangles)
        boxes.push_back(boundsOf(t));
    const Bvh bvh = buildBvh(boxes, kLeafTriangles);
    if (bvh.nodes.empty()) return {};
    const Grid grid(bvh.nodes[0].bounds);
    const uint32_t firstNode = uint32_t(trees.nodes.size()), firstTriangle = uint32_t(trees.triangles.size());
    for (const BvhNode& node : bvh.nodes)
        trees.nodes.push_back(packed(node, grid, firstNode, firstTriangle));
    for (const uint32_t item : bvh.order) {
        const Triangle& t = triangles[item];
        const glm::vec3 corner = grid(t.corners[0]);
        trees.triangles.push_back(
            {.corner = corner,
             .opacity = t.opacity,
             .edge1 = grid(t.corners[1]) - corner,
             .reflects = (io::packReflectance(t.sent.reflectance) + 1) * (t.front < 0 ? -1.0f : 1.0f),
             .edge2 = grid(t.corners[2]) - corner,
             .shines = (io::packRadiance(t.sent.radiance) + 1) * (t.front == 0 ? -1.0f : 1.0f)});
        trees.masks.push_back(t.mask);
    }
    return {firstNode, uint32_t(trees.nodes.size()), bvh.nodes[0].bounds};
}

// Takes what depends on textures from some places on the triangle.
void lookUp(const SampledScene& scene, uint32_t mesh, const std::array<glm::vec2, 3>& uvs, LookUpSent sentAt,
            LookUpMask maskOf, Triangle& t) {
    constexpr uint32_t kPlaces = 16;
    uint32_t left = 0;
    SentAt sum;
    for (uint32_t i = 0; i < kPlaces; ++i) {
        const glm::vec2 xi = io::hammersley(i, kPlaces);
        const float root = std::sqrt(xi.x);
        const glm::vec2 uv = (1 - root) * uvs[0] + root * (1 - xi.y) * uvs[1] + root * xi.y * uvs[2];
        if (scene.isCutOut(mesh, uv)) continue;
        left += 1;
        const SentAt sent = sentAt(mesh, uv);
        sum.reflectance += sent.reflectance, sum.radiance += sent.radiance;
    }
    t.opacity = float(left) / kPlaces;
    if (left < kPlaces) t.mask = maskOf(mesh, uvs);
    const float share = 1.0f / float(std::max(left, 1u));
    t.sent = {sum.reflectance * share, sum.radiance * share};
}

void appendTriangles(const SampledScene& scene, uint32_t meshIndex, const Strided<glm::vec3>& positions,
                     const glm::mat4x3& transform, LookUpSent sentAt, LookUpMask maskOf,
                     std::vector<Triangle>& triangles) {
    const SampledMesh& mesh = scene.meshes[meshIndex];
    if (!mesh.blocksLight) return;
    const float outside = glm::determinant(glm::mat3(transform)) < 0 ? -1.0f : 1.0f;
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        Triangle t{.front = mesh.doubleSided ? 0 : outside};
        std::array<glm::vec2, 3> uvs{};
        glm::vec3 tint(mesh.colors ? 0 : 1);
        for (size_t k = 0; k < 3; ++k) {
            t.corners[k] = transform * glm::vec4(positions[mesh.indices[i + k]], 1);
            if (mesh.uvs) uvs[k] = mesh.uvs[mesh.indices[i + k]];
            if (mesh.colors)
                tint += glm::vec3(glm::unpackUnorm3x10_1x2(mesh.colors[mesh.indices[i + k]])) / 3.0f;
        }
        lookUp(scene, meshIndex, uvs, sentAt, maskOf, t);
        t.sent.reflectance *= tint;
        if (t.opacity > 0) triangles.push_back(t);
    }
}

OccluderTrees withoutIdleMasks(OccluderTrees trees) {
    const auto isMasked = [](const io::BvhTriangle& t) { return t.opacity < 1; };
    if (std::ranges::none_of(trees.triangles, isMasked)) trees.masks = {};
    return trees;
}

glm::mat4x3 inverseOf(const glm::mat4x3& m) {
    const glm::mat3 back = glm::inverse(glm::mat3(m));
    return {back[0], back[1], back[2], back * -m[3]};
}

Bounds transformed(const glm::mat4x3& m, const Bounds& b) {
    const glm::vec3 c = m * glm::vec4(0.5f * (b.min + b.max), 1), h = 0.5f * (b.max - b.min);
    const glm::vec3 reach = glm::abs(m[0]) * h.x + glm::abs(m[1]) * h.y + glm::abs(m[2]) * h.z;
    return {c - reach, c + reach};
}

}  // namespace

TreeUpkeep::Task TreeUpkeep::next(uint64_t version) {
    constexpr uint32_t kRestFrames = 16;
    if (wanted_ != version) restedFrames_ = 0;
    wanted_ = version;
    if (built_ == version) return Task::kUse;
    if (built_ != 0 && restedFrames_++ < kRestFrames) return Task::kNone;
    built_ = version;
    return Task::kBuild;
}

io::BvhPlace placeOf(const TreeRange& tree, const glm::mat4x3& treeFromWorld) {
    io::BvhPlace place{};
    if (tree.empty()) return place;
    Grid(tree.bounds).place(treeFromWorld, place);
    place.firstNode = tree.firstNode;
    place.endNode = tree.endNode;
    return place;
}

OccluderTrees buildOccluderTrees(const SampledScene& scene, TreesOf of, LookUpSent sentAt,
                                 LookUpMask maskOf) {
    OccluderTrees trees;
    trees.ofMesh.resize(scene.meshes.size());
    std::vector<Triangle> triangles;
    for (const SampledInstance& instance : scene.instances)
        if (instance.isPresent && !instance.movable)
            appendTriangles(scene, instance.mesh, scene.meshes[instance.mesh].positions,
                            instance.worldFromLocal, sentAt, maskOf, triangles);
    trees.everythingStatic = append(trees, triangles);
    if (of == TreesOf::kStatic) return withoutIdleMasks(std::move(trees));
    for (const SampledInstance& instance : scene.instances) {
        if (!instance.isPresent || !instance.movable || !trees.ofMesh[instance.mesh].empty()) continue;
        triangles.clear();
        appendTriangles(scene, instance.mesh, scene.meshes[instance.mesh].positions, glm::mat4x3(1), sentAt,
                        maskOf, triangles);
        trees.ofMesh[instance.mesh] = append(trees, triangles);
    }
    return withoutIdleMasks(std::move(trees));
}

MoverTree placeTrees(const OccluderTrees& trees, std::span<const SampledInstance> instances) {
    MoverTree result;
    placeTrees(trees, instances, result);
    return result;
}

void placeTrees(const OccluderTrees& trees, std::span<const SampledInstance> instances, MoverTree& result) {
    result.nodes.clear();
    result.places.assign(io::kBvhFirstMover, {});
    result.places[io::kBvhStatic] = placeOf(trees.everythingStatic, glm::mat4x3(1));
    auto& [boxes, places, bvh] = result.scratch;
    boxes.clear();
    places.clear();
    for (const SampledInstance& instance : instances) {
        if (!instance.isPresent || !instance.movable || trees.ofMesh[instance.mesh].empty()) continue;
        const TreeRange& tree = trees.ofMesh[instance.mesh];
        const Bounds box = transformed(instance.worldFromLocal, tree.bounds);
        const glm::vec3 size = box.max - box.min;
        if (!std::isfinite(glm::dot(size, size)) ||
            std::abs(glm::determinant(glm::mat3(instance.worldFromLocal))) < 1e-30f)
            continue;
        boxes.push_back(box);
        places.push_back(placeOf(tree, inverseOf(instance.worldFromLocal)));
    }
    if (boxes.size() > kMostSorted)
        buildBvhAlongCurve(boxes, bvh);
    else
        buildBvh(boxes, 1, bvh);
    if (bvh.nodes.empty()) return;
    const TreeRange range{0, uint32_t(bvh.nodes.size()), bvh.nodes[0].bounds};
    const Grid grid(range.bounds);
    for (const BvhNode& node : bvh.nodes)
        result.nodes.push_back(packed(node, grid, 0, 0));
    result.places[io::kBvhMovers] = placeOf(range, glm::mat4x3(1));
    for (const uint32_t item : bvh.order)
        result.places.push_back(places[item]);
}

void readTrees(PassBuilder& pass, const TracedOccluders& trees) {
    pass.read("treeNodes", trees.nodes)
        .read("treeTriangles", trees.triangles)
        .read("treePlaces", trees.places)
        .read("moverNodes", trees.moverNodes);
}

}  // namespace ag::gi
