#include "gi/library/guest_context.h"

#include "engine/core/failure.h"
#include "engine/gpu/barrier.h"
#include "gi/library/embedded_shaders.h"

namespace ag::guest {
namespace {

gpu::MemorySource memoryOf(const AgiContextInfo& info) {
    if (!info.allocate) return {};
    // Pieces are known by where they lie; what is the host's own goes back with them.
    auto owners = std::make_shared<std::vector<AgiMemoryPiece>>();
    return {.allocate =
                [=](uint64_t bytes, uint32_t type, bool hostVisible, gpu::MemoryBlock& block) {
                    AgiMemoryPiece piece{};
                    const VkResult result = info.allocate(info.user, bytes, type, hostVisible, &piece);
                    if (result != VK_SUCCESS) return result;
                    owners->push_back(piece);
                    block = {piece.memory, piece.offset, static_cast<std::byte*>(piece.mapped)};
                    return VK_SUCCESS;
                },
            .release =
                [=](const gpu::MemoryBlock& block) {
                    for (size_t i = 0; i < owners->size(); ++i) {
                        const AgiMemoryPiece piece = (*owners)[i];
                        if (piece.memory != block.memory || piece.offset != block.offset) continue;
                        owners->erase(owners->begin() + std::ptrdiff_t(i));
                        return info.release(info.user, &piece);
                    }
                }};
}

gpu::DeviceInfo describe(const gpu::Functions& vk, VkPhysicalDevice physical) {
    gpu::DeviceInfo info = gpu::describeDevice(vk, physical);
    if (const std::string missing = gpu::whatIsMissing(info); !missing.empty())
        fail(FailureKind::kUnsupported, missing);
    // The host may not have switched these on.
    info.counts = false;
    info.mostAnisotropy = 1;
    return info;
}

}  // namespace

gpu::Functions loadFunctions(PFN_vkGetInstanceProcAddr getInstanceProcAddr, VkInstance instance,
                             VkDevice device) {
    gpu::Functions vk;
    vk.GetInstanceProcAddr = getInstanceProcAddr;
    gpu::loadInstanceFunctions(vk, instance);
    if (device) gpu::loadDeviceFunctions(vk, device);
    return vk;
}

GuestContext::GuestContext(const AgiContextInfo& info)
    : gpu_(loadFunctions(info.getInstanceProcAddr, info.instance, info.device),
           {.instance = info.instance,
            .physical = info.physicalDevice,
            .device = info.device,
            .queueFamily = info.queueFamily,
            .pipelineCache = info.pipelineCache,
            .hostAllocation = info.hostAllocation},
           describe(loadFunctions(info.getInstanceProcAddr, info.instance, VK_NULL_HANDLE),
                    info.physicalDevice),
           memoryOf(info)),
      pipelines_(gpu_, embeddedShader),
      white_(gpu_, {.name = "guest.white", .format = VK_FORMAT_R8G8B8A8_UNORM, .size = {1, 1}}) {
    makeSampler();
}

GuestContext::~GuestContext() {
    gpu_.finish(UINT64_MAX);
    gpu_.vk().DestroySampler(gpu_.handle(), albedoSampler_, gpu_.hostAllocation());
}

void GuestContext::makeSampler() {
    const VkSamplerCreateInfo info{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                   .magFilter = VK_FILTER_LINEAR,
                                   .minFilter = VK_FILTER_LINEAR,
                                   .mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR,
                                   .maxLod = VK_LOD_CLAMP_NONE};
    AG_VK(gpu_.vk().CreateSampler(gpu_.handle(), &info, gpu_.hostAllocation(), &albedoSampler_));
    gpu_.setDebugName(VK_OBJECT_TYPE_SAMPLER, albedoSampler_, "guest.albedo");
}

void GuestContext::fillWhite(VkCommandBuffer commands) {
    if (whiteFrame_ != 0) return;
    const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    const VkClearColorValue white{{1, 1, 1, 1}};
    gpu::transitionImage(gpu_.vk(), commands, white_.handle(), all, VK_IMAGE_LAYOUT_UNDEFINED,
                         VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    gpu_.vk().CmdClearColorImage(commands, white_.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &white, 1,
                                 &all);
    gpu::transitionImage(gpu_.vk(), commands, white_.handle(), all, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                         VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    whiteFrame_ = lastFrame_;
}

void GuestContext::forgetFrame(uint64_t frame) {
    if (whiteFrame_ == frame) whiteFrame_ = 0;
}

void GuestContext::beginFrame(uint64_t frame, uint64_t framesDone) {
    gpu_.record(frame);
    gpu_.finish(framesDone);
    lastFrame_ = frame;
}

}  // namespace ag::guest
