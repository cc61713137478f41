#include "gi/library/rsm_draws.h"

#include <algorithm>
#include <array>

#include "engine/core/hash.h"
#include "engine/gpu/retire.h"
#include "gi/light_views.h"
#include "shaders/guest/guest_io.h"

namespace ag::guest {
namespace {

bool isMirrored(const GuestInstance& instance) {
    return glm::determinant(instance.linear) < 0;
}

}  // namespace

RsmDraws::Pool::~Pool() {
    context.vk().DestroyDescriptorPool(context.handle(), handle, context.hostAllocation());
}

RsmDraws::~RsmDraws() {
    gpu::retireOwned(context_.gpu(), std::move(pool_));
}

void RsmDraws::listDraws(const GuestScene& scene, const SceneOnDevice& device,
                         const glm::mat4& clipFromWorld) {
    firstOfFace_.push_back(draws_.size());
    const gi::Frustum frustum = gi::frustumOf(clipFromWorld);
    const auto& instances = scene.instances();
    for (uint32_t row = 0; row < instances.size(); ++row)
        if (gi::mayMeet(frustum, device.boundsOf(row))) draws_.push_back({row, instances[row].mesh});
    std::sort(
        draws_.begin() + std::ptrdiff_t(firstOfFace_.back()), draws_.end(),
        [](const Draw& a, const Draw& b) { return std::pair(a.mesh, a.row) < std::pair(b.mesh, b.row); });
}

// Lists anew only when a face, a place or what is drawn changed.
void RsmDraws::listFaces(const GuestScene& scene, const SceneOnDevice& device, const gi::RsmSet& rsm) {
    const auto faces = std::span(rsm.faceInfo).first(rsm.lightFaceCount);
    const uint64_t of = combineHash(combineHash(scene.id(), scene.drawnVersion()),
                                    combineHash(device.placesVersion(), hashBytes(std::as_bytes(faces))));
    if (listedOf_ == of) return;
    listedOf_ = 0;
    draws_.clear();
    firstOfFace_.clear();
    key_ = scene.drawnVersion();
    for (const io::RsmFace& face : faces) {
        listDraws(scene, device, face.clipFromWorld);
        key_ = hashValue(face, key_);
        for (size_t i = firstOfFace_.back(); i < draws_.size(); ++i)
            key_ = combineHash(combineHash(key_, draws_[i].row), device.rowVersions()[draws_[i].row]);
    }
    firstOfFace_.push_back(draws_.size());
    listedOf_ = of;
}

void RsmDraws::add(GraphScope scope, const GuestScene& scene, const SceneOnDevice& device,
                   BufferHandle instances, gi::RsmSet& rsm) {
    listFaces(scene, device, rsm);
    rsm.inputsVersion = combineHash(rsm.inputsVersion, key_);
    scope.raster("guest.rsms", "guest/rsm.vert", "guest/rsm.frag", gpu::VertexLayout::kStrided)
        .colorClear(rsm.normal, glm::vec4(0))
        .colorClear(rsm.albedo, glm::vec4(0))
        .depthClear(rsm.depth)
        .read("instances", instances)
        .key(key_)
        .record([this, &scene, rsm](const PassRecording& to) { record(to, scene, rsm); });
}

// One set a material, of its map or of white; made anew when materials are others.
void RsmDraws::makeSets(const GuestScene& scene, const gpu::Pipeline& pipeline) {
    const size_t count = scene.materials().size();
    const uint64_t of = combineHash(combineHash(combineHash(scene.id(), scene.drawnVersion()), count),
                                    uint64_t(pipeline.drawSetLayout));
    if (setsOf_ == of) return;
    gpu::Context& gpu = context_.gpu();
    gpu::retireOwned(gpu, std::move(pool_));
    pool_ = std::make_unique<Pool>(gpu);
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, uint32_t(count)};
    const VkDescriptorPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                          .maxSets = uint32_t(count),
                                          .poolSizeCount = 1,
                                          .pPoolSizes = &size};
    AG_VK(gpu.vk().CreateDescriptorPool(gpu.handle(), &info, gpu.hostAllocation(), &pool_->handle));
    const std::vector<VkDescriptorSetLayout> layouts(count, pipeline.drawSetLayout);
    sets_.assign(count, VK_NULL_HANDLE);
    const VkDescriptorSetAllocateInfo allocation{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                                 .descriptorPool = pool_->handle,
                                                 .descriptorSetCount = uint32_t(count),
                                                 .pSetLayouts = layouts.data()};
    AG_VK(gpu.vk().AllocateDescriptorSets(gpu.handle(), &allocation, sets_.data()));
    for (size_t i = 0; i < count; ++i) {
        const VkImageView map = scene.materials()[i].map;
        const VkDescriptorImageInfo image{context_.albedoSampler(), map ? map : context_.white(),
                                          VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
        const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                         .dstSet = sets_[i],
                                         .descriptorCount = 1,
                                         .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                         .pImageInfo = &image};
        gpu.vk().UpdateDescriptorSets(gpu.handle(), 1, &write, 0, nullptr);
    }
    setsOf_ = of;
}

void RsmDraws::record(const PassRecording& to, const GuestScene& scene, const gi::RsmSet& rsm) {
    if (draws_.empty()) return;
    makeSets(scene, *to.pipeline);
    for (uint32_t f = 0; f < rsm.lightFaceCount; ++f)
        drawFace(to, scene, rsm.faceInfo[f],
                 std::span(draws_).subspan(firstOfFace_[f], firstOfFace_[f + 1] - firstOfFace_[f]));
}

void RsmDraws::drawFace(const PassRecording& to, const GuestScene& scene, const io::RsmFace& face,
                        std::span<const Draw> draws) {
    const gpu::Functions& vk = context_.gpu().vk();
    const VkViewport viewport{
        float(face.origin.x), float(face.origin.y), float(face.size), float(face.size), 0, 1};
    const VkRect2D scissor{{int32_t(face.origin.x), int32_t(face.origin.y)}, {face.size, face.size}};
    vk.CmdSetViewport(to.commands, 0, 1, &viewport);
    vk.CmdSetScissor(to.commands, 0, 1, &scissor);
    uint32_t bound = ~0u;
    for (const Draw& draw : draws) {
        const GuestMesh& mesh = scene.meshes()[draw.mesh];
        const AgiMesh& given = mesh.given;
        const GuestMaterial& material = scene.materials()[given.material];
        if (std::exchange(bound, draw.mesh) != draw.mesh) {
            const bool uvs = given.uvStride > 0;  // else any three floats do
            const std::array<VkBuffer, 3> buffers = {given.vertexBuffer, given.vertexBuffer,
                                                     given.vertexBuffer};
            const std::array<VkDeviceSize, 3> offsets = {given.positionOffset, given.normalOffset,
                                                         uvs ? given.uvOffset : given.positionOffset};
            const std::array<VkDeviceSize, 3> strides = {given.positionStride, given.normalStride,
                                                         uvs ? given.uvStride : given.positionStride};
            vk.CmdBindVertexBuffers2(to.commands, 0, 3, buffers.data(), offsets.data(), nullptr,
                                     strides.data());
            vk.CmdBindIndexBuffer(to.commands, given.indexBuffer, given.indexOffset, given.indexType);
            vk.CmdBindDescriptorSets(to.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, to.pipeline->layout, 1, 1,
                                     &sets_[given.material], 0, nullptr);
            const io::GuestRsmPush push{.clipFromWorld = face.clipFromWorld,
                                        .albedo = material.albedo,
                                        .alphaCutoff = material.alphaCutoff,
                                        .doubleSided = material.doubleSided,
                                        .mapped = material.map != VK_NULL_HANDLE};
            vk.CmdPushConstants(to.commands, to.pipeline->layout, to.pipeline->pushStages, 0, sizeof push,
                                &push);
        }
        const bool clockwise = bool(given.clockwise) != isMirrored(scene.instances()[draw.row]);
        vk.CmdSetFrontFace(to.commands,
                           clockwise ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE);
        vk.CmdDrawIndexed(to.commands, given.indexCount, 1, 0, 0, draw.row);
    }
}

}  // namespace ag::guest
