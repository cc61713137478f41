#include "engine/renderer/skinning.h"

#include <algorithm>

#include "engine/core/hash.h"
#include "engine/gpu/transfer.h"
#include "engine/renderer/scene_gpu.h"

namespace ag::render {
namespace {

static_assert(io::kSkinGroup == kSkinnedMeshAlignment && sizeof(io::SkinnedVertex) == sizeof(SkinVertex) &&
              sizeof(io::VertexRow) == sizeof(VertexAttributes));

io::SkinRow rowOf(const RenderSkinnedMesh& f) {
    return {f.firstVertex, f.vertexCount, f.firstDeformed, f.firstJoint};
}

uint32_t groupsOf(uint32_t vertices) {
    return (vertices + io::kSkinGroup - 1) / io::kSkinGroup;
}

uint32_t deformedCount(const RenderScene& scene) {
    const RenderSkinnedMesh& last = scene.skinnedMeshes.back();
    return last.firstDeformed + groupsOf(last.vertexCount) * io::kSkinGroup;
}

std::unique_ptr<gpu::Buffer> jointBuffer(gpu::Device& device, const char* name, size_t joints) {
    return std::make_unique<gpu::Buffer>(device, gpu::BufferDesc{.name = name,
                                                                 .sizeBytes = joints * sizeof(glm::mat3x4),
                                                                 .texelFormat = gpu::kVec4Texels});
}

uint64_t hashTable(const RenderScene& scene) {
    uint64_t hash = combineHash(scene.geometry->version, scene.skinnedMeshes.size());
    for (const RenderSkinnedMesh& skinnedMesh : scene.skinnedMeshes)
        hash = hashValue(rowOf(skinnedMesh), combineHash(hash, skinnedMesh.jointCount));
    return hash | 1;
}

}  // namespace

void SkinGpu::load(const GeometryArrays& geometry) {
    tableVersion_ = 0;
    skin_.reset(), skinnedMeshes_.reset(), groups_.reset(), joints_.reset(), previousJoints_.reset();
    geometryVersion_ = geometry.version;
    if (!geometry.skin.empty()) skin_ = gpu::loadBuffer(device_, {.name = "skinning.skin"}, geometry.skin);
}

// Blocking: skinned meshes come and go with all instances.
void SkinGpu::makeBuffers(const RenderScene& scene) {
    std::vector<io::SkinRow> rows;
    std::vector<uint32_t> groups(deformedCount(scene) / io::kSkinGroup);
    for (const RenderSkinnedMesh& skinnedMesh : scene.skinnedMeshes) {
        const auto first = groups.begin() + skinnedMesh.firstDeformed / io::kSkinGroup;
        std::fill_n(first, groupsOf(skinnedMesh.vertexCount), uint32_t(rows.size()));
        rows.push_back(rowOf(skinnedMesh));
    }
    for (auto* old : {&skinnedMeshes_, &groups_, &joints_, &previousJoints_})
        gpu::retire(device_, std::move(*old));
    skinnedMeshes_ = gpu::loadBuffer(device_, {.name = "skinning.rows"}, rows);
    groups_ = gpu::loadBuffer(device_, {.name = "skinning.groups"}, groups);
    joints_ = jointBuffer(device_, "skinning.joints", scene.joints.size());
    previousJoints_ = jointBuffer(device_, "skinning.previous_joints", scene.joints.size());
    uploadedPoses_.assign(scene.skinnedMeshes.size(), 0);
}

SkinView SkinGpu::import(GraphScope scope, const RenderScene& scene, const gpu::Buffer& positions,
                         const gpu::Buffer& attributes) {
    if (scene.skinnedMeshes.empty() || scene.joints.empty() || deformedCount(scene) == 0) return {};
    const uint64_t table = hashTable(scene);
    if (std::exchange(tableVersion_, table) != table) makeBuffers(scene);
    const uint64_t vertices = deformedCount(scene);
    SkinView view{.skinnedMeshes = scope.importBuffer("skinning.rows", *skinnedMeshes_, table),
                  .groups = scope.importBuffer("skinning.groups", *groups_, table),
                  .joints = scope.importBuffer("skinning.joints", *joints_, 1),
                  .previousJoints = scope.importBuffer("skinning.previous_joints", *previousJoints_, 1),
                  .skin = scope.importBuffer("skinning.skin", *skin_, geometryVersion_),
                  .positions = scope.importBuffer("scene.positions", positions, geometryVersion_),
                  .attributes = scope.importBuffer("scene.attributes", attributes, geometryVersion_)};
    view.deformedPositions =
        scope.buffer("skinning.positions", {.sizeBytes = vertices * sizeof(glm::vec3), .vertices = true});
    view.deformedAttributes = scope.buffer(
        "skinning.attributes", {.sizeBytes = vertices * sizeof(VertexAttributes), .vertices = true});
    return view;
}

std::vector<VkBufferCopy> SkinGpu::copiesToPrevious(const RenderScene& scene,
                                                    std::span<const RenderScene::Range> rows) const {
    std::vector<VkBufferCopy> copies;
    uint32_t before = kNoSkinnedMesh;  // a skinned mesh's rows lie side by side
    for (const RenderScene::Range& range : rows)
        for (uint32_t row = range.begin; row < range.end; ++row) {
            const uint32_t index = scene.instances[row].skinnedMesh;
            if (index == kNoSkinnedMesh || std::exchange(before, index) == index) continue;
            const RenderSkinnedMesh& skinnedMesh = scene.skinnedMeshes[index];
            const uint64_t offset = skinnedMesh.firstJoint * sizeof(glm::mat3x4),
                           size = skinnedMesh.jointCount * sizeof(glm::mat3x4);
            if (!copies.empty() && copies.back().srcOffset + copies.back().size == offset)
                copies.back().size += size;
            else
                copies.push_back({offset, offset, size});
        }
    return copies;
}

void SkinGpu::upload(const RenderScene& scene, Stage stage) {
    if (tableVersion_ == 0) return;
    const auto changed = [&](size_t i) { return uploadedPoses_[i] != scene.skinnedMeshes[i].poseVersion; };
    for (size_t i = 0; i < scene.skinnedMeshes.size();) {
        if (!changed(i)) {
            ++i;
            continue;
        }
        const uint32_t first = scene.skinnedMeshes[i].firstJoint;
        uint32_t end = first;
        for (; i < scene.skinnedMeshes.size() && changed(i); ++i) {
            end = scene.skinnedMeshes[i].firstJoint + scene.skinnedMeshes[i].jointCount;
            uploadedPoses_[i] = scene.skinnedMeshes[i].poseVersion;
        }
        stage(std::as_bytes(std::span(scene.joints).subspan(first, end - first)), *joints_,
              first * sizeof(glm::mat3x4));
    }
}

uint64_t SkinGpu::deviceBytes() const {
    uint64_t bytes = 0;
    for (const auto* buffer :
         {skin_.get(), skinnedMeshes_.get(), groups_.get(), joints_.get(), previousJoints_.get()})
        if (buffer) bytes += buffer->sizeBytes();
    return bytes;
}

void addSkinning(GraphScope scope, const SceneView& scene) {
    const SkinView& s = scene.skin;
    if (!s) return;
    PassBuilder pass = scope.compute("skinning.deform", "skinning/deform.comp");
    pass.read("groups", s.groups)
        .read("skinnedMeshes", s.skinnedMeshes)
        .read("joints", s.joints)
        .read("skin", s.skin)
        .read("positions", s.positions)
        .read("attributes", s.attributes)
        .parts("deformedPositions", s.deformedPositions)
        .parts("deformedAttributes", s.deformedAttributes)
        .push(uint32_t(0));
    for (const RenderSkinnedMesh& skinnedMesh : scene.scene->skinnedMeshes) {
        const uint64_t key =
            hashValue(rowOf(skinnedMesh), combineHash(scene.loadedVersion, skinnedMesh.poseVersion));
        pass.part(skinnedMesh.firstDeformed / io::kSkinGroup, groupsOf(skinnedMesh.vertexCount), key);
    }
}

void readSkinnedMeshes(PassBuilder& pass, const SkinView& skin) {
    if (!skin) return;
    pass.read("deformedPositions", skin.deformedPositions)
        .read("deformedAttributes", skin.deformedAttributes);
}

}  // namespace ag::render
