#include "engine/gpu/resources.h"

#include <algorithm>
#include <atomic>

#include "engine/gpu/device.h"

namespace ag::gpu {
namespace {

uint64_t nextId() {
    static std::atomic<uint64_t> last{0};
    return ++last;
}

VkBufferUsageFlags usageOf(Device& device, const BufferDesc& desc) {
    VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                               VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    if (desc.sizeBytes <= 65536) usage |= VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT;
    if (desc.indirect) usage |= VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
    if (desc.vertexOrIndex) usage |= VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT;
    if (desc.texelFormat == VK_FORMAT_UNDEFINED) return usage;
    VkFormatProperties properties;
    device.vk().GetPhysicalDeviceFormatProperties(device.physical(), desc.texelFormat, &properties);
    if (properties.bufferFeatures & VK_FORMAT_FEATURE_UNIFORM_TEXEL_BUFFER_BIT)
        usage |= VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    if (properties.bufferFeatures & VK_FORMAT_FEATURE_STORAGE_TEXEL_BUFFER_BIT)
        usage |= VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT;
    return usage;
}

VkImageUsageFlags usageOf(Device& device, const ImageDesc& desc) {
    VkFormatProperties properties;
    device.vk().GetPhysicalDeviceFormatProperties(device.physical(), desc.format, &properties);
    const VkFormatFeatureFlags features = properties.optimalTilingFeatures;
    VkImageUsageFlags usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    if (features & VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT) usage |= VK_IMAGE_USAGE_SAMPLED_BIT;
    if (features & VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT) usage |= VK_IMAGE_USAGE_STORAGE_BIT;
    if (features & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT) usage |= VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    if (features & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT)
        usage |= VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    return usage;
}

VkImageView makeView(Device& device, const Image& image, uint32_t firstMip, uint32_t mips) {
    const ImageDesc& desc = image.desc();
    const VkImageViewCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = image.handle(),
        .viewType = desc.array || desc.layers > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D,
        .format = desc.format,
        .subresourceRange = {image.aspect(), firstMip, mips, 0, desc.layers}};
    VkImageView view = VK_NULL_HANDLE;
    AG_VK(device.vk().CreateImageView(device.handle(), &info, nullptr, &view));
    device.setDebugName(VK_OBJECT_TYPE_IMAGE_VIEW, view, desc.name);
    return view;
}

}  // namespace

bool isDepthFormat(VkFormat format) {
    return format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_D16_UNORM ||
           format == VK_FORMAT_D24_UNORM_S8_UINT;
}

Buffer::Buffer(Device& device, const BufferDesc& desc) : device_(device), desc_(desc), id_(nextId()) {
    AG_CHECK_MSG(desc.sizeBytes > 0, desc.name);
    const VkBufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                  .size = desc.sizeBytes,
                                  .usage = usageOf(device, desc)};
    AG_VK(device.vk().CreateBuffer(device.handle(), &info, nullptr, &handle_));
    VkMemoryRequirements requirements;
    device.vk().GetBufferMemoryRequirements(device.handle(), handle_, &requirements);
    memory_ = device.memory().allocate(requirements, desc.hostVisible, MemoryUse::kBuffer);
    AG_VK(device.vk().BindBufferMemory(device.handle(), handle_, memory_.memory, memory_.offset));
    mapped_ = desc.hostVisible ? memory_.mapped : nullptr;
    device.setDebugName(VK_OBJECT_TYPE_BUFFER, handle_, desc.name);
    if (desc.texelFormat == VK_FORMAT_UNDEFINED) return;
    const VkBufferViewCreateInfo view{.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
                                      .buffer = handle_,
                                      .format = desc.texelFormat,
                                      .range = VK_WHOLE_SIZE};
    AG_VK(device.vk().CreateBufferView(device.handle(), &view, nullptr, &texelView_));
    device.setDebugName(VK_OBJECT_TYPE_BUFFER_VIEW, texelView_, desc.name);
}

Buffer::~Buffer() {
    device_.vk().DestroyBufferView(device_.handle(), texelView_, nullptr);
    device_.vk().DestroyBuffer(device_.handle(), handle_, nullptr);
    device_.memory().free(memory_);
}

Image::Image(Device& device, const ImageDesc& desc, const MemoryRange* memory)
    : device_(device), desc_(desc), id_(nextId()) {
    AG_CHECK_MSG(desc.size.x > 0 && desc.size.y > 0, desc.name);
    handle_ = makeImage(device, desc);
    MemoryRange place;
    if (memory) {
        place = *memory;
    } else {
        VkMemoryRequirements requirements;
        device.vk().GetImageMemoryRequirements(device.handle(), handle_, &requirements);
        place = memory_ = device.memory().allocate(requirements, false, MemoryUse::kImage);
    }
    AG_VK(device.vk().BindImageMemory(device.handle(), handle_, place.memory, place.offset));
    device.setDebugName(VK_OBJECT_TYPE_IMAGE, handle_, desc.name);
    view_ = makeView(device, *this, 0, desc.mips);
    mipViews_ = std::make_unique<VkImageView[]>(desc.mips);
    for (uint32_t mip = 0; mip < desc.mips; ++mip)
        mipViews_[mip] = makeView(device, *this, mip, 1);
}

Image::~Image() {
    for (uint32_t mip = 0; mip < desc_.mips; ++mip)
        device_.vk().DestroyImageView(device_.handle(), mipViews_[mip], nullptr);
    device_.vk().DestroyImageView(device_.handle(), view_, nullptr);
    device_.vk().DestroyImage(device_.handle(), handle_, nullptr);
    if (memory_) device_.memory().free(memory_);
}

VkImage makeImage(Device& device, const ImageDesc& desc) {
    const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                 .imageType = VK_IMAGE_TYPE_2D,
                                 .format = desc.format,
                                 .extent = {desc.size.x, desc.size.y, 1},
                                 .mipLevels = desc.mips,
                                 .arrayLayers = desc.layers,
                                 .samples = VK_SAMPLE_COUNT_1_BIT,
                                 .tiling = VK_IMAGE_TILING_OPTIMAL,
                                 .usage = usageOf(device, desc),
                                 .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED};
    VkImage image = VK_NULL_HANDLE;
    AG_VK(device.vk().CreateImage(device.handle(), &info, nullptr, &image));
    return image;
}

VkMemoryRequirements imageRequirements(Device& device, const ImageDesc& desc) {
    const VkImage probe = makeImage(device, desc);
    VkMemoryRequirements requirements;
    device.vk().GetImageMemoryRequirements(device.handle(), probe, &requirements);
    device.vk().DestroyImage(device.handle(), probe, nullptr);
    return requirements;
}

VkImageView Image::mipView(uint32_t mip) const {
    AG_CHECK_LT(mip, desc_.mips);
    return mipViews_[mip];
}

VkImageAspectFlags Image::aspect() const {
    return isDepthFormat(desc_.format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

}  // namespace ag::gpu
