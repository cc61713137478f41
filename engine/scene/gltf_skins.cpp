// Skins, and the joints and weights of vertices.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/scene/gltf_internal.h"

namespace ag::gltf {
namespace {

constexpr float kMostInverseBind = 1e12f;

int attribute(const tinygltf::Primitive& p, const std::string& name) {
    const auto found = p.attributes.find(name);
    return found == p.attributes.end() ? -1 : found->second;
}

bool isFourOf(const tinygltf::Model& model, int accessor, std::initializer_list<int> components) {
    const tinygltf::Accessor& a = model.accessors[size_t(accessor)];
    return a.type == TINYGLTF_TYPE_VEC4 && std::ranges::find(components, a.componentType) != components.end();
}

// Sets of four joints and weights: _0, _1 and so on, as many as there are.
struct Influences {
    std::vector<std::vector<uint32_t>> joints;
    std::vector<std::vector<float>> weights;
};

Fault readInfluences(const tinygltf::Model& model, const tinygltf::Primitive& p, const std::string& what,
                     Influences& out) {
    for (int set = 0;; ++set) {
        const int joints = attribute(p, fmt::format("JOINTS_{}", set)),
                  weights = attribute(p, fmt::format("WEIGHTS_{}", set));
        if (joints < 0 && weights < 0) return std::nullopt;
        if (joints < 0 || weights < 0)
            return fmt::format("{} has JOINTS_{} or WEIGHTS_{} without the other", what, set, set);
        if (!isFourOf(model, joints,
                      {TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT}))
            return fmt::format("{} has joints that are not four small whole numbers", what);
        if (!isFourOf(model, weights,
                      {TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
                       TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT}))
            return fmt::format("{} has weights that are not four numbers up to one", what);
        out.joints.push_back(readUints(model, joints, 4));
        out.weights.push_back(readFloats(model, weights, 4));
    }
}

// The four with the greatest weights, which then are 1 together; all zero if the vertex has none.
SkinVertex strongestFour(const Influences& in, size_t vertex) {
    struct One {
        float weight;
        uint32_t joint;
    };
    std::vector<One> all;
    for (size_t set = 0; set < in.joints.size(); ++set)
        for (size_t c = vertex * 4; c < vertex * 4 + 4; ++c)
            if (in.weights[set][c] > 0) all.push_back({in.weights[set][c], in.joints[set][c]});
    std::ranges::stable_sort(all, std::ranges::greater{}, &One::weight);
    all.resize(std::min<size_t>(all.size(), 4));
    float sum = 0;
    for (const One& one : all)
        sum += one.weight;
    SkinVertex out;
    for (size_t i = 0; i < all.size(); ++i) {
        out.joints[int(i)] = uint16_t(all[i].joint);
        out.weights[int(i)] = all[i].weight / sum;
    }
    return out;
}

// What a mesh asks of a skin that bends it.
struct MeshNeeds {
    uint32_t joints = 0;    // at least so many
    uint64_t vertices = 0;  // a skinned mesh has
    bool whole = true;      // every vertex has a weight
};

MeshNeeds needsOf(const GeometryArrays& g, const SceneMesh& mesh) {
    MeshNeeds needs;
    uint32_t first = ~0u, end = 0;
    for (uint32_t p = mesh.firstPrimitive; p < mesh.firstPrimitive + mesh.primitiveCount; ++p)
        for (uint32_t i = 0; i < g.primitives[p].indexCount; ++i) {
            const uint32_t v =
                uint32_t(g.primitives[p].vertexOffset) + g.indices[g.primitives[p].firstIndex + i];
            first = std::min(first, v);
            end = std::max(end, v + 1);
            const SkinVertex& s = g.skin[v];
            needs.whole = needs.whole && s.weights.x > 0;
            for (int c = 0; c < 4; ++c)
                if (s.weights[c] > 0) needs.joints = std::max(needs.joints, uint32_t(s.joints[c]) + 1);
        }
    needs.vertices = end > first ? end - first : 0;
    return needs;
}

// Every node that shows a mesh bent by a skin, against both.
Fault checkSkinnedMeshes(const SceneAsset& asset, const ImportLimits& limits) {
    std::vector<std::optional<MeshNeeds>> needs(asset.meshes.size());
    uint64_t vertices = 0, joints = 0;
    for (const SceneNode& node : asset.nodes) {
        if (node.mesh < 0 || node.skin < 0) continue;
        const SceneSkin& skin = asset.skins[size_t(node.skin)];
        auto& mesh = needs[size_t(node.mesh)];
        if (!mesh) mesh = needsOf(asset.geometry, asset.meshes[size_t(node.mesh)]);
        if (skin.joints.empty())
            return fmt::format("skin {} of node '{}' has no joints in its scene", node.skin, node.name);
        if (!mesh->whole)
            return fmt::format("mesh {} of node '{}' has a skin, but vertices without weights", node.mesh,
                               node.name);
        if (mesh->joints > skin.joints.size())
            return fmt::format("mesh {} names joint {}, but skin {} has only {}", node.mesh, mesh->joints - 1,
                               node.skin, skin.joints.size());
        vertices += mesh->vertices;
        joints += skin.joints.size();
        if (vertices > limits.vertices || joints > limits.joints)
            return "its skinnedMeshes together have more vertices or joints than the limit";
    }
    return std::nullopt;
}

}  // namespace

Fault checkSkins(const tinygltf::Model& model, const ImportLimits& limits) {
    uint64_t joints = 0;
    for (size_t i = 0; i < model.skins.size(); ++i) {
        const tinygltf::Skin& s = model.skins[i];
        joints += s.joints.size();
        if (joints > limits.joints) return "its skins together have more joints than the limit";
        for (int joint : s.joints)
            if (joint < 0 || size_t(joint) >= model.nodes.size())
                return fmt::format("skin {} names joint {}, which does not exist", i, joint);
        if (s.inverseBindMatrices == -1) continue;
        const bool there =
            s.inverseBindMatrices >= 0 && size_t(s.inverseBindMatrices) < model.accessors.size();
        if (!there) return fmt::format("skin {} has bad inverse bind matrices", i);
        const tinygltf::Accessor& a = model.accessors[size_t(s.inverseBindMatrices)];
        if (a.type != TINYGLTF_TYPE_MAT4 || a.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT ||
            a.count < s.joints.size())
            return fmt::format("skin {} has bad inverse bind matrices", i);
    }
    return std::nullopt;
}

Fault readSkin(const tinygltf::Model& model, const tinygltf::Primitive& p, const std::string& what,
               std::vector<SkinVertex>& skin) {
    Influences in;
    if (Fault f = readInfluences(model, p, what, in)) return f;
    if (in.joints.empty()) return std::nullopt;
    for (const std::vector<float>& set : in.weights)
        for (size_t i = 0; i < set.size(); ++i)
            if (!(set[i] >= 0 && set[i] < 1e6f))
                return fmt::format("{} has a weight that is negative or not finite (vertex {})", what, i / 4);
    skin.resize(in.weights[0].size() / 4);
    for (size_t i = 0; i < skin.size(); ++i)
        skin[i] = strongestFour(in, i);
    return std::nullopt;
}

Fault importSkins(const tinygltf::Model& model, std::span<const int32_t> newIndex, SceneAsset& asset,
                  const ImportLimits& limits) {
    for (size_t i = 0; i < model.skins.size(); ++i) {
        const tinygltf::Skin& s = model.skins[i];
        SceneSkin skin{.name = s.name};
        const bool inScene =
            std::ranges::all_of(s.joints, [&](int joint) { return newIndex[size_t(joint)] >= 0; });
        for (int joint : s.joints)
            if (inScene) skin.joints.push_back(uint32_t(newIndex[size_t(joint)]));
        skin.inverseBind.resize(skin.joints.size(), glm::mat4(1));
        if (s.inverseBindMatrices >= 0) {
            const std::vector<float> values = readFloats(model, s.inverseBindMatrices, 16);
            for (size_t k = 0; k < skin.joints.size() * 16; ++k) {
                if (!(std::abs(values[k]) < kMostInverseBind))
                    return fmt::format("skin {} has an inverse bind matrix that is not finite", i);
                skin.inverseBind[k / 16][int(k % 16 / 4)][int(k % 4)] = values[k];
            }
        }
        asset.skins.push_back(std::move(skin));
    }
    return checkSkinnedMeshes(asset, limits);
}

}  // namespace ag::gltf
