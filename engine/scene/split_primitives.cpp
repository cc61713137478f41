#include "engine/scene/split_primitives.h"

#include <algorithm>
#include <array>
#include <span>

namespace ag {
namespace {

using Triangle = std::array<uint32_t, 3>;

glm::vec3 cornerAt(const GeometryArrays& g, const Primitive& p, uint32_t index) {
    return g.positions[size_t(int64_t(index) + p.vertexOffset)];
}

glm::vec3 centerOf(const GeometryArrays& g, const Primitive& p, const Triangle& t) {
    return (cornerAt(g, p, t[0]) + cornerAt(g, p, t[1]) + cornerAt(g, p, t[2])) / 3.0f;
}

// Appends the pieces of some triangles of `whole`, whose indices begin at `firstIndex`, and orders them.
void addPieces(const GeometryArrays& g, const Primitive& whole, std::span<Triangle> triangles,
               uint32_t firstIndex, uint32_t most, std::vector<Primitive>& pieces) {
    Bounds corners, centers;
    for (const Triangle& t : triangles) {
        centers.add(centerOf(g, whole, t));
        for (const uint32_t index : t)
            corners.add(cornerAt(g, whole, index));
    }
    if (triangles.size() <= most) {
        Primitive piece = whole;
        piece.firstIndex = firstIndex;
        piece.indexCount = uint32_t(3 * triangles.size());
        piece.boundsLocal = corners;
        pieces.push_back(piece);
        return;
    }
    const glm::vec3 size = centers.max - centers.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const size_t half = triangles.size() / 2;
    std::ranges::nth_element(triangles, triangles.begin() + std::ptrdiff_t(half), {},
                             [&](const Triangle& t) { return centerOf(g, whole, t)[axis]; });
    addPieces(g, whole, triangles.first(half), firstIndex, most, pieces);
    addPieces(g, whole, triangles.subspan(half), firstIndex + uint32_t(3 * half), most, pieces);
}

}  // namespace

void splitLargePrimitives(SceneAsset& asset, uint32_t mostTriangles) {
    GeometryArrays& g = asset.geometry;
    std::vector<Primitive> pieces;
    for (SceneMesh& mesh : asset.meshes) {
        const auto first = uint32_t(pieces.size());
        for (uint32_t i = 0; i < mesh.primitiveCount; ++i) {
            const Primitive& p = g.primitives[mesh.firstPrimitive + i];
            if (p.indexCount / 3 <= mostTriangles) {
                pieces.push_back(p);
                continue;
            }
            std::vector<Triangle> triangles(p.indexCount / 3);
            for (size_t t = 0; t < triangles.size(); ++t)
                std::copy_n(g.indices.begin() + p.firstIndex + 3 * t, 3, triangles[t].begin());
            addPieces(g, p, triangles, p.firstIndex, mostTriangles, pieces);
            for (size_t t = 0; t < triangles.size(); ++t)
                std::ranges::copy(triangles[t], g.indices.begin() + p.firstIndex + 3 * t);
        }
        mesh.firstPrimitive = first;
        mesh.primitiveCount = uint32_t(pieces.size()) - first;
    }
    g.primitives = std::move(pieces);
}

}  // namespace ag
