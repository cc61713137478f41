// Meshes to triangle lists with normals; what cannot be drawn is left out with a warning.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "engine/scene/gltf_internal.h"

namespace ag::gltf {
namespace {

struct Triangles {
    std::vector<glm::vec3> positions;
    std::vector<VertexAttributes> attributes;
    std::vector<SkinVertex> skin;
    std::vector<uint32_t> indices;
};

int attribute(const tinygltf::Primitive& p, const char* name) {
    const auto found = p.attributes.find(name);
    return found == p.attributes.end() ? -1 : found->second;
}

bool finite(glm::vec3 p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

template <class V, class F>
void fill(const tinygltf::Model& model, int accessor, size_t vertices, F&& set) {
    if (accessor < 0) return;
    constexpr int kComponents = V::length();
    const std::vector<float> values = readFloats(model, accessor, kComponents);
    for (size_t i = 0; i < vertices; ++i) {
        V v;
        for (int c = 0; c < kComponents; ++c)
            v[c] = values[i * size_t(kComponents) + size_t(c)];
        set(i, v);
    }
}

std::vector<uint32_t> indicesOf(const tinygltf::Model& model, const tinygltf::Primitive& p, size_t vertices) {
    if (p.indices >= 0) return readUints(model, p.indices, 1);
    std::vector<uint32_t> all(vertices);
    for (size_t i = 0; i < vertices; ++i)
        all[i] = uint32_t(i);
    return all;
}

// Strips and fans to lists; empty for points and lines.
std::vector<uint32_t> toList(std::vector<uint32_t> in, int mode) {
    if (mode == TINYGLTF_MODE_TRIANGLES || mode == -1) {
        in.resize(in.size() / 3 * 3);
        return in;
    }
    std::vector<uint32_t> out;
    if (mode != TINYGLTF_MODE_TRIANGLE_STRIP && mode != TINYGLTF_MODE_TRIANGLE_FAN) return out;
    for (size_t i = 2; i < in.size(); ++i) {
        const bool fan = mode == TINYGLTF_MODE_TRIANGLE_FAN, odd = i % 2 == 1;
        out.push_back(fan ? in[0] : in[i - (odd ? 1 : 2)]);
        out.push_back(fan ? in[i - 1] : in[i - (odd ? 2 : 1)]);
        out.push_back(in[i]);
    }
    return out;
}

size_t dropDegenerate(Triangles& t) {
    size_t kept = 0;
    for (size_t i = 0; i + 2 < t.indices.size(); i += 3) {
        const glm::vec3 a = t.positions[t.indices[i]], b = t.positions[t.indices[i + 1]],
                        c = t.positions[t.indices[i + 2]];
        const glm::dvec3 n = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
        if (!(glm::dot(n, n) > 0)) continue;
        for (size_t k = 0; k < 3; ++k)
            t.indices[kept++] = t.indices[i + k];
    }
    const size_t dropped = (t.indices.size() - kept) / 3;
    t.indices.resize(kept);
    return dropped;
}

// Of the triangle whose indices start there; it has an area.
glm::vec3 faceNormal(const Triangles& t, size_t first) {
    const glm::dvec3 a(t.positions[t.indices[first]]), b(t.positions[t.indices[first + 1]]),
        c(t.positions[t.indices[first + 2]]);
    return glm::vec3(glm::normalize(glm::cross(b - a, c - a)));
}

// glTF asks for flat normals where none are given: every triangle then needs vertices of its own.
void makeFlatNormals(Triangles& t) {
    Triangles flat;
    for (size_t i = 0; i + 2 < t.indices.size(); i += 3) {
        const glm::vec3 normal = faceNormal(t, i);
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t old = t.indices[i + k];
            flat.indices.push_back(uint32_t(flat.positions.size()));
            flat.positions.push_back(t.positions[old]);
            flat.attributes.push_back(t.attributes[old]);
            flat.attributes.back().normal = normal;
            flat.attributes.back().tangent = glm::vec4(0);
            if (!t.skin.empty()) flat.skin.push_back(t.skin[old]);
        }
    }
    t = std::move(flat);
}

// Zero or broken normals take that of a triangle they belong to, or any where they belong to none.
size_t repairNormals(Triangles& t) {
    size_t repaired = 0;
    std::vector<bool> broken(t.positions.size(), false);
    for (size_t i = 0; i < t.positions.size(); ++i) {
        glm::vec3& n = t.attributes[i].normal;
        const double length = glm::length(glm::dvec3(n));
        broken[i] = !finite(n) || !(length > 1e-6);
        n = broken[i] ? glm::vec3(0, 1, 0) : glm::vec3(glm::dvec3(n) / length);
        repaired += broken[i];
    }
    if (repaired == 0) return 0;
    for (size_t i = 0; i + 2 < t.indices.size(); i += 3) {
        for (size_t k = 0; k < 3; ++k)
            if (broken[t.indices[i + k]]) t.attributes[t.indices[i + k]].normal = faceNormal(t, i);
    }
    return repaired;
}

// What morph targets add to one attribute: sum of weight times displacement, no entry where there is none.
std::vector<glm::vec3> morphOf(const tinygltf::Model& model, const tinygltf::Primitive& p, const char* name,
                               std::span<const double> weights, size_t vertices) {
    std::vector<glm::vec3> sum;
    for (size_t t = 0; t < std::min(weights.size(), p.targets.size()); ++t) {
        const auto target = p.targets[t].find(name);
        if (target == p.targets[t].end() || weights[t] == 0) continue;
        sum.resize(vertices, glm::vec3(0));
        fill<glm::vec3>(model, target->second, vertices,
                        [&](size_t i, glm::vec3 v) { sum[i] += floatOf(weights[t]) * v; });
    }
    return sum;
}

void addMorphs(const tinygltf::Model& model, const tinygltf::Primitive& p, std::span<const double> weights,
               Triangles& t) {
    const std::vector<glm::vec3> moved = morphOf(model, p, "POSITION", weights, t.positions.size()),
                                 turned = morphOf(model, p, "NORMAL", weights, t.positions.size()),
                                 along = morphOf(model, p, "TANGENT", weights, t.positions.size());
    for (size_t i = 0; i < moved.size(); ++i)
        t.positions[i] += moved[i];
    for (size_t i = 0; i < turned.size(); ++i)
        t.attributes[i].normal += turned[i];
    for (size_t i = 0; i < along.size(); ++i)
        t.attributes[i].tangent += glm::vec4(along[i], 0);
}

// The set of texture coordinates that the primitive's material is mapped with: the base colour's, else that
// of the first texture it has.
std::string uvSetOf(const tinygltf::Model& model, const tinygltf::Primitive& p) {
    if (p.material < 0) return "TEXCOORD_0";
    const int set = uvSetsOf(model.materials[size_t(p.material)]).first;
    return fmt::format("TEXCOORD_{}", set);
}

Fault readTriangles(const tinygltf::Model& model, const tinygltf::Primitive& p,
                    std::span<const double> weights, const std::string& what, Triangles& t,
                    std::vector<std::string>& warnings) {
    const int position = attribute(p, "POSITION");
    const size_t vertices = model.accessors[size_t(position)].count;
    t.positions.resize(vertices);
    t.attributes.resize(vertices, {.normal = glm::vec3(0), .tangent = glm::vec4(0)});
    fill<glm::vec3>(model, position, vertices, [&](size_t i, glm::vec3 v) { t.positions[i] = v; });
    fill<glm::vec3>(model, attribute(p, "NORMAL"), vertices,
                    [&](size_t i, glm::vec3 v) { t.attributes[i].normal = v; });
    fill<glm::vec4>(model, attribute(p, "TANGENT"), vertices,
                    [&](size_t i, glm::vec4 v) { t.attributes[i].tangent = v; });
    addMorphs(model, p, weights, t);
    for (size_t i = 0; i < vertices; ++i)
        if (!finite(t.positions[i]))
            return fmt::format("{} has a position that is not finite (vertex {})", what, i);
        else if (glm::any(glm::greaterThan(glm::abs(t.positions[i]), glm::vec3(kFarthest))))
            return fmt::format("{} has a position farther off than {:g} m (vertex {})", what, kFarthest, i);
    fill<glm::vec2>(model, attribute(p, uvSetOf(model, p).c_str()), vertices,
                    [&](size_t i, glm::vec2 v) { t.attributes[i].uv = v; });
    fill<glm::vec3>(model, attribute(p, "COLOR_0"), vertices, [&](size_t i, glm::vec3 v) {
        if (finite(v)) t.attributes[i].color = glm::packUnorm3x10_1x2(glm::vec4(v, 1));
    });
    if (Fault f = readSkin(model, p, what, t.skin)) return f;

    t.indices = toList(indicesOf(model, p, vertices), p.mode);
    for (uint32_t index : t.indices)
        if (index >= vertices)
            return fmt::format("{} has index {}, but only {} vertices", what, index, vertices);
    if (t.indices.empty()) warnings.push_back(what + " holds no triangles and is left out");
    if (const size_t dropped = dropDegenerate(t))
        warnings.push_back(fmt::format("{}: {} triangles without area are left out", what, dropped));
    if (attribute(p, "NORMAL") < 0)
        makeFlatNormals(t);
    else if (const size_t repaired = repairNormals(t))
        warnings.push_back(fmt::format("{}: {} broken normals are replaced", what, repaired));
    return std::nullopt;
}

void append(Triangles&& t, uint32_t material, bool skinned, SceneAsset& asset) {
    GeometryArrays& g = asset.geometry;
    Primitive primitive{.firstIndex = uint32_t(g.indices.size()),
                        .indexCount = uint32_t(t.indices.size()),
                        .vertexOffset = int32_t(g.positions.size()),
                        .material = material};
    for (uint32_t index : t.indices)
        primitive.boundsLocal.add(t.positions[index]);
    g.positions.insert(g.positions.end(), t.positions.begin(), t.positions.end());
    g.attributes.insert(g.attributes.end(), t.attributes.begin(), t.attributes.end());
    g.indices.insert(g.indices.end(), t.indices.begin(), t.indices.end());
    if (skinned) {
        t.skin.resize(t.positions.size());
        g.skin.insert(g.skin.end(), t.skin.begin(), t.skin.end());
    }
    g.primitives.push_back(primitive);
}

// One of the file's meshes, with its morph targets at some weights.
Fault importMesh(const tinygltf::Model& model, size_t m, std::span<const double> weights, SceneAsset& asset,
                 std::vector<std::string>& warnings) {
    const uint32_t fallback = uint32_t(asset.geometry.materials.size() - 1);
    SceneMesh mesh{model.meshes[m].name, uint32_t(asset.geometry.primitives.size()), 0};
    for (size_t i = 0; i < model.meshes[m].primitives.size(); ++i) {
        const tinygltf::Primitive& p = model.meshes[m].primitives[i];
        Triangles triangles;
        if (Fault f = readTriangles(model, p, weights, fmt::format("mesh {} primitive {}", m, i), triangles,
                                    warnings))
            return f;
        if (triangles.indices.empty()) continue;
        asset.geometry.materials[p.material < 0 ? fallback : uint32_t(p.material)].vertexColors |=
            attribute(p, "COLOR_0") >= 0;
        append(std::move(triangles), p.material < 0 ? fallback : uint32_t(p.material), !model.skins.empty(),
               asset);
        ++mesh.primitiveCount;
    }
    asset.meshes.push_back(std::move(mesh));
    return std::nullopt;
}

}  // namespace

std::pair<int, bool> uvSetsOf(const tinygltf::Material& m) {
    int first = -1;
    bool several = false;
    const auto add = [&](const auto& texture) {
        if (texture.index < 0) return;
        const auto transform = texture.extensions.find("KHR_texture_transform");
        const double set = transform == texture.extensions.end()
                               ? texture.texCoord
                               : numberOf(transform->second, "texCoord", texture.texCoord);
        const int uvs = int(std::clamp(set, 0.0, 1e6));
        several = several || (first >= 0 && uvs != first);
        if (first < 0) first = uvs;
    };
    add(m.pbrMetallicRoughness.baseColorTexture);
    add(m.pbrMetallicRoughness.metallicRoughnessTexture);
    add(m.normalTexture);
    add(m.emissiveTexture);
    return {std::max(first, 0), several};
}

bool hasOwnMorph(const tinygltf::Model& model, const tinygltf::Node& n) {
    return n.mesh >= 0 && !n.weights.empty() && n.weights != model.meshes[size_t(n.mesh)].weights;
}

Fault importMeshes(const tinygltf::Model& model, SceneAsset& asset, std::vector<int32_t>& meshOfNode) {
    for (size_t m = 0; m < model.meshes.size(); ++m)
        if (Fault f = importMesh(model, m, model.meshes[m].weights, asset, asset.warnings)) return f;
    std::vector<std::string> saidBefore;
    for (const tinygltf::Node& n : model.nodes) {
        meshOfNode.push_back(n.mesh);
        if (!hasOwnMorph(model, n)) continue;
        meshOfNode.back() = int32_t(asset.meshes.size());
        saidBefore.clear();
        if (Fault f = importMesh(model, size_t(n.mesh), n.weights, asset, saidBefore)) return f;
    }
    return std::nullopt;
}

}  // namespace ag::gltf
