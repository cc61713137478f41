#include "engine/scene/skinned_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "engine/core/hash.h"
#include "engine/scene/animation.h"

namespace ag {
namespace {

glm::mat4 matrixOf(const NodeTransform& t) {
    const glm::mat3 r = glm::mat3_cast(t.rotation);
    return {glm::vec4(r[0] * t.scale.x, 0), glm::vec4(r[1] * t.scale.y, 0), glm::vec4(r[2] * t.scale.z, 0),
            glm::vec4(glm::vec3(t.translation), 1)};
}

// Parts that are fine one by one may leave the range of floats together: then all that hangs from the joint
// meets in a point.
glm::mat3x4 withinReach(const glm::mat3x4& joint) {
    constexpr float kLargest = 1e8f, kFarthest = 1e12f;  // m; normals need the scale's fourth power
    bool near = true;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 4; ++c)
            near = near && std::abs(joint[r][c]) < (c < 3 ? kLargest : kFarthest);
    return near ? joint : glm::mat3x4(0);
}

// The deepest node that all joints hang from and that is none of them; -1: the world.
int32_t frameOf(const SceneAsset& asset, const SceneSkin& skin) {
    int32_t common = asset.nodes[skin.joints[0]].parent;
    for (const uint32_t joint : skin.joints) {
        int32_t other = asset.nodes[joint].parent;
        while (common != other) {  // parents come before children
            int32_t& later = common > other ? common : other;
            later = asset.nodes[size_t(later)].parent;
        }
    }
    while (common >= 0 && std::ranges::find(skin.joints, uint32_t(common)) != skin.joints.end())
        common = asset.nodes[size_t(common)].parent;
    return common;
}

void gatherNodes(const SceneAsset& asset, const SceneSkin& skin, SkinnedModel& model,
                 std::unordered_map<int32_t, int32_t>& placeOf) {
    std::vector<uint32_t> nodes;
    for (const uint32_t joint : skin.joints)
        for (int32_t at = int32_t(joint); at != model.frame && placeOf.try_emplace(at).second;
             at = asset.nodes[size_t(at)].parent)
            nodes.push_back(uint32_t(at));
    std::ranges::sort(nodes);  // parents come before children
    for (const uint32_t node : nodes) {
        const int32_t parent = asset.nodes[node].parent;
        placeOf[int32_t(node)] = int32_t(model.nodes.size());
        model.nodes.push_back({node, parent == model.frame ? -1 : placeOf[parent]});
    }
    for (const uint32_t joint : skin.joints)
        model.jointNodes.push_back(uint32_t(placeOf[int32_t(joint)]));
}

void gatherVertices(const GeometryArrays& g, const SceneMesh& mesh, SkinnedModel& model) {
    uint32_t first = ~0u, end = 0;
    model.jointBounds.resize(model.jointNodes.size());
    for (uint32_t i = mesh.firstPrimitive; i < mesh.firstPrimitive + mesh.primitiveCount; ++i) {
        const Primitive& p = g.primitives[i];
        for (uint32_t k = p.firstIndex; k < p.firstIndex + p.indexCount; ++k) {
            const uint32_t v = uint32_t(p.vertexOffset) + g.indices[k];
            first = std::min(first, v);
            end = std::max(end, v + 1);
            for (int c = 0; c < 4; ++c)
                if (g.skin[v].weights[c] > 0) model.jointBounds[g.skin[v].joints[c]].add(g.positions[v]);
        }
    }
    model.firstVertex = std::min(first, end);
    model.vertexCount = end - model.firstVertex;
}

SkinnedModel makeModel(const SkinnedMeshLibrary& library, uint32_t mesh, uint32_t skin) {
    const SceneAsset& asset = *library.asset;
    SkinnedModel model{.mesh = mesh, .skin = skin, .frame = frameOf(asset, asset.skins[skin])};
    std::unordered_map<int32_t, int32_t> placeOf;  // of the asset's nodes among the model's
    gatherNodes(asset, asset.skins[skin], model, placeOf);
    gatherVertices(asset.geometry, asset.meshes[mesh], model);
    for (uint32_t a = 0; a < asset.animations.size(); ++a) {
        auto& channels = model.animations.emplace_back();
        for (uint32_t n = 0; n < model.nodes.size(); ++n)
            for (const uint32_t channel : library.channelsOf(a, model.nodes[n].node))
                channels.push_back({channel, n});
    }
    return model;
}

}  // namespace

std::span<const uint32_t> SkinnedMeshLibrary::channelsOf(uint32_t animation, uint32_t node) const {
    const auto nodeOf = [&](uint32_t c) { return asset->animations[animation].channels[c].node; };
    const std::vector<uint32_t>& order = channels[animation];  // equal_range's result needs clang 16
    return {std::ranges::lower_bound(order, node, {}, nodeOf),
            std::ranges::upper_bound(order, node, {}, nodeOf)};
}

SkinnedMeshLibrary makeSkinnedMeshLibrary(const SceneAsset& asset) {
    SkinnedMeshLibrary library{.asset = &asset};
    for (const SceneAnimation& animation : asset.animations) {
        auto& order = library.channels.emplace_back(animation.channels.size());
        std::iota(order.begin(), order.end(), 0u);
        std::ranges::stable_sort(order, {}, [&](uint32_t c) { return animation.channels[c].node; });
    }
    library.modelOfNode.resize(asset.nodes.size(), -1);
    std::unordered_map<uint64_t, int32_t> modelOf;  // of a mesh and a skin
    for (size_t i = 0; i < asset.nodes.size(); ++i) {
        const SceneNode& node = asset.nodes[i];
        if (node.mesh < 0 || node.skin < 0 || asset.skins[size_t(node.skin)].joints.empty()) continue;
        const uint64_t pair = uint64_t(node.mesh) << 32 | uint64_t(node.skin);
        const auto [known, added] = modelOf.try_emplace(pair, int32_t(library.models.size()));
        library.modelOfNode[i] = known->second;
        if (added) library.models.push_back(makeModel(library, uint32_t(node.mesh), uint32_t(node.skin)));
    }
    return library;
}

void poseSkinnedMesh(const SkinnedMeshLibrary& library, uint32_t index, int32_t animation, float seconds,
                     std::span<glm::mat3x4> joints) {
    const SceneAsset& asset = *library.asset;
    const SkinnedModel& model = library.models[index];
    thread_local std::vector<NodeTransform> locals;
    thread_local std::vector<glm::mat4> places;
    locals.clear();
    for (const SkinnedModel::PoseNode& n : model.nodes)
        locals.push_back(asset.nodes[n.node].local);
    if (animation >= 0 && size_t(animation) < asset.animations.size())
        for (const SkinnedModel::PoseChannel& c : model.animations[size_t(animation)])
            applyChannel(asset.animations[size_t(animation)].channels[c.channel], seconds, locals[c.node]);
    places.clear();
    for (size_t i = 0; i < model.nodes.size(); ++i) {
        const int32_t parent = model.nodes[i].parent;
        const glm::mat4 local = matrixOf(locals[i]);
        places.push_back(parent < 0 ? local : places[size_t(parent)] * local);
    }
    const SceneSkin& skin = asset.skins[model.skin];
    for (size_t j = 0; j < joints.size(); ++j)
        joints[j] =
            withinReach(glm::mat3x4(glm::transpose(places[model.jointNodes[j]] * skin.inverseBind[j])));
}

Bounds boundsOfPose(const SkinnedModel& model, std::span<const glm::mat3x4> joints) {
    Bounds all;
    for (size_t j = 0; j < joints.size(); ++j) {
        const Bounds& local = model.jointBounds[j];
        if (local.empty()) continue;
        const glm::vec3 c = (local.min + local.max) * 0.5f, h = (local.max - local.min) * 0.5f;
        const glm::vec3 middle = glm::vec4(c, 1) * joints[j];
        glm::vec3 reach;
        for (int r = 0; r < 3; ++r)
            reach[r] = glm::dot(glm::abs(glm::vec3(joints[j][r])), h);
        all.add({middle - reach, middle + reach});
    }
    return all;
}

uint32_t addSkinnedMesh(const SkinnedModel& model, RenderScene& scene) {
    RenderSkinnedMesh skinnedMesh{.firstVertex = model.firstVertex,
                                  .vertexCount = model.vertexCount,
                                  .firstJoint = uint32_t(scene.joints.size()),
                                  .jointCount = uint32_t(model.jointNodes.size())};
    if (!scene.skinnedMeshes.empty()) {
        const RenderSkinnedMesh& last = scene.skinnedMeshes.back();
        const uint32_t end = last.firstDeformed + last.vertexCount;
        skinnedMesh.firstDeformed =
            (end + kSkinnedMeshAlignment - 1) / kSkinnedMeshAlignment * kSkinnedMeshAlignment;
    }
    scene.joints.resize(scene.joints.size() + skinnedMesh.jointCount);
    scene.skinnedMeshes.push_back(skinnedMesh);
    return uint32_t(scene.skinnedMeshes.size() - 1);
}

bool finishPose(const SkinnedModel& model, RenderScene& scene, uint32_t index) {
    RenderSkinnedMesh& skinnedMesh = scene.skinnedMeshes[index];
    const auto joints = std::span(scene.joints).subspan(skinnedMesh.firstJoint, skinnedMesh.jointCount);
    const uint64_t version = hashBytes(std::as_bytes(joints)) | 1;
    if (version == skinnedMesh.poseVersion) return false;
    skinnedMesh.poseVersion = version;
    skinnedMesh.boundsLocal = boundsOfPose(model, joints);
    return true;
}

}  // namespace ag
