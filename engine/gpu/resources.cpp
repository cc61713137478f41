#include "engine/gpu/resources.h"

#include <algorithm>
#include <atomic>

#include "engine/gpu/context.h"
#include "engine/gpu/retire.h"

namespace ag::gpu {
namespace {

uint64_t nextId() {
    static std::atomic<uint64_t> last{0};
    return ++last;
}

VkBufferUsageFlags usageOf(Context& context, const BufferDesc& desc) {
    VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                               VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    if (desc.sizeBytes <= 65536) usage |= VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT;
    if (desc.indirect) usage |= VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
    if (desc.vertexOrIndex) usage |= VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT;
    if (desc.texelFormat == VK_FORMAT_UNDEFINED) return usage;
    VkFormatProperties properties;
    context.vk().GetPhysicalDeviceFormatProperties(context.physical(), desc.texelFormat, &properties);
    if (properties.bufferFeatures & VK_FORMAT_FEATURE_UNIFORM_TEXEL_BUFFER_BIT)
        usage |= VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    if (properties.bufferFeatures & VK_FORMAT_FEATURE_STORAGE_TEXEL_BUFFER_BIT)
        usage |= VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT;
    return usage;
}

VkImageUsageFlags usageOf(Context& context, const ImageDesc& desc) {
    VkFormatProperties properties;
    context.vk().GetPhysicalDeviceFormatProperties(context.physical(), desc.format, &properties);
    const VkFormatFeatureFlags features = properties.optimalTilingFeatures;
    VkImageUsageFlags usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    if (features & VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT) usage |= VK_IMAGE_USAGE_SAMPLED_BIT;
    if (features & VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT) usage |= VK_IMAGE_USAGE_STORAGE_BIT;
    if (features & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT) usage |= VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    if (features & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT)
        usage |= VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    return usage;
}

VkImageView makeView(Context& context, const Image& image, uint32_t firstMip, uint32_t mips) {
    const ImageDesc& desc = image.desc();
    const VkImageViewCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = image.handle(),
        .viewType = desc.array || desc.layers > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D,
        .format = desc.format,
        .subresourceRange = {image.aspect(), firstMip, mips, 0, desc.layers}};
    VkImageView view = VK_NULL_HANDLE;
    AG_VK(context.vk().CreateImageView(context.handle(), &info, context.hostAllocation(), &view));
    context.setDebugName(VK_OBJECT_TYPE_IMAGE_VIEW, view, desc.name);
    return view;
}

// Both queues' families where they differ, but for what has one owner at a time.
struct Sharing {
    VkSharingMode mode = VK_SHARING_MODE_EXCLUSIVE;
    uint32_t count = 0;
    uint32_t families[2] = {0, 0};

    explicit Sharing(const Context& context, bool owned = false) {
        if (!context.twoFamilies() || owned) return;
        mode = VK_SHARING_MODE_CONCURRENT;
        count = 2;
        families[0] = context.queueFamily();
        families[1] = *context.asyncFamily();
    }
};

}  // namespace

bool isDepthFormat(VkFormat format) {
    return format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_D16_UNORM ||
           format == VK_FORMAT_D24_UNORM_S8_UINT;
}

Buffer::Buffer(Context& context, const BufferDesc& desc) : context_(context), desc_(desc), id_(nextId()) {
    AG_CHECK_MSG(desc.sizeBytes > 0, desc.name);
    try {
        create();
        createTexelView();
    } catch (...) {
        destroy();
        throw;
    }
}

Buffer::Buffer(Context& context, const BufferDesc& desc, VkBuffer borrowed)
    : context_(context), desc_(desc), id_(nextId()), handle_(borrowed), borrowed_(true) {
    createTexelView();
}

Buffer::~Buffer() {
    destroy();
}

void Buffer::create() {
    const Sharing sharing(context_);
    const VkBufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                  .size = desc_.sizeBytes,
                                  .usage = usageOf(context_, desc_),
                                  .sharingMode = sharing.mode,
                                  .queueFamilyIndexCount = sharing.count,
                                  .pQueueFamilyIndices = sharing.families};
    AG_VK(context_.vk().CreateBuffer(context_.handle(), &info, context_.hostAllocation(), &handle_));
    VkMemoryRequirements requirements;
    context_.vk().GetBufferMemoryRequirements(context_.handle(), handle_, &requirements);
    memory_ = context_.memory().allocate(requirements, desc_.hostVisible, MemoryUse::kBuffer);
    AG_VK(context_.vk().BindBufferMemory(context_.handle(), handle_, memory_.memory, memory_.offset));
    mapped_ = desc_.hostVisible ? memory_.mapped : nullptr;
    context_.setDebugName(VK_OBJECT_TYPE_BUFFER, handle_, desc_.name);
}

void Buffer::createTexelView() {
    if (desc_.texelFormat == VK_FORMAT_UNDEFINED) return;
    const uint64_t most = context_.info().limits.maxTexelBufferElements;
    const uint64_t elements = desc_.sizeBytes / texelSizeBytes(desc_.texelFormat);
    if (elements > most && context_.info().storageTexels) return;  // nothing wants the view
    if (elements > most)
        failBeyondLimit("the texel buffer " + desc_.name, "maxTexelBufferElements", elements, most);
    const VkBufferViewCreateInfo view{.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
                                      .buffer = handle_,
                                      .format = desc_.texelFormat,
                                      .range = VK_WHOLE_SIZE};
    AG_VK(context_.vk().CreateBufferView(context_.handle(), &view, context_.hostAllocation(), &texelView_));
    context_.setDebugName(VK_OBJECT_TYPE_BUFFER_VIEW, texelView_, desc_.name);
}

void Buffer::destroy() {
    context_.vk().DestroyBufferView(context_.handle(), texelView_, context_.hostAllocation());
    if (!borrowed_) context_.vk().DestroyBuffer(context_.handle(), handle_, context_.hostAllocation());
    if (memory_) context_.memory().free(memory_);
}

Image::Image(Context& context, const ImageDesc& desc, const MemoryRange* memory)
    : context_(context), desc_(desc), id_(nextId()) {
    AG_CHECK_MSG(desc.size.x > 0 && desc.size.y > 0, desc.name);
    try {
        create(memory);
    } catch (...) {
        destroy();
        throw;
    }
}

Image::Image(Context& context, const ImageDesc& desc, VkImage borrowed, VkImageView view)
    : context_(context), desc_(desc), id_(nextId()), borrowed_(true), handle_(borrowed), view_(view) {}

Image::~Image() {
    destroy();
}

void Image::create(const MemoryRange* memory) {
    handle_ = makeImage(context_, desc_);
    MemoryRange place;
    if (memory) {
        place = *memory;
    } else {
        VkMemoryRequirements requirements;
        context_.vk().GetImageMemoryRequirements(context_.handle(), handle_, &requirements);
        place = memory_ = context_.memory().allocate(requirements, false, MemoryUse::kImage);
    }
    AG_VK(context_.vk().BindImageMemory(context_.handle(), handle_, place.memory, place.offset));
    context_.setDebugName(VK_OBJECT_TYPE_IMAGE, handle_, desc_.name);
    view_ = makeView(context_, *this, 0, desc_.mips);
    mipViews_ = std::make_unique<VkImageView[]>(desc_.mips);
    for (uint32_t mip = 0; mip < desc_.mips; ++mip)
        mipViews_[mip] = makeView(context_, *this, mip, 1);
}

void Image::destroy() {
    if (borrowed_) return;
    const VkDevice device = context_.handle();
    for (uint32_t mip = 0; mipViews_ && mip < desc_.mips; ++mip)
        context_.vk().DestroyImageView(device, mipViews_[mip], context_.hostAllocation());
    context_.vk().DestroyImageView(device, view_, context_.hostAllocation());
    context_.vk().DestroyImage(device, handle_, context_.hostAllocation());
    if (memory_) context_.memory().free(memory_);
}

VkImage makeImage(Context& context, const ImageDesc& desc) {
    const VkPhysicalDeviceLimits& limits = context.info().limits;
    if (const uint32_t side = std::max(desc.size.x, desc.size.y); side > limits.maxImageDimension2D)
        failBeyondLimit("a side of the image " + desc.name, "maxImageDimension2D", side,
                        limits.maxImageDimension2D);
    if (desc.layers > limits.maxImageArrayLayers)
        failBeyondLimit("the image " + desc.name, "maxImageArrayLayers", desc.layers,
                        limits.maxImageArrayLayers);
    const Sharing sharing(context, desc.owned);
    const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                 .imageType = VK_IMAGE_TYPE_2D,
                                 .format = desc.format,
                                 .extent = {desc.size.x, desc.size.y, 1},
                                 .mipLevels = desc.mips,
                                 .arrayLayers = desc.layers,
                                 .samples = VK_SAMPLE_COUNT_1_BIT,
                                 .tiling = VK_IMAGE_TILING_OPTIMAL,
                                 .usage = usageOf(context, desc),
                                 .sharingMode = sharing.mode,
                                 .queueFamilyIndexCount = sharing.count,
                                 .pQueueFamilyIndices = sharing.families,
                                 .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED};
    VkImage image = VK_NULL_HANDLE;
    AG_VK(context.vk().CreateImage(context.handle(), &info, context.hostAllocation(), &image));
    return image;
}

VkMemoryRequirements imageRequirements(Context& context, const ImageDesc& desc) {
    const VkImage probe = makeImage(context, desc);
    VkMemoryRequirements requirements;
    context.vk().GetImageMemoryRequirements(context.handle(), probe, &requirements);
    context.vk().DestroyImage(context.handle(), probe, context.hostAllocation());
    return requirements;
}

VkImageView Image::mipView(uint32_t mip) const {
    if (borrowed_) return view_;
    AG_CHECK_LT(mip, desc_.mips);
    return mipViews_[mip];
}

VkImageAspectFlags Image::aspect() const {
    return isDepthFormat(desc_.format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

void retire(Context& context, std::unique_ptr<Buffer> buffer) {
    retireOwned(context, std::move(buffer));
}

uint32_t texelSizeBytes(VkFormat format) {
    switch (format) {
        case VK_FORMAT_R8_UNORM:
            return 1;
        case VK_FORMAT_R16_SFLOAT:
            return 2;
        case VK_FORMAT_R8G8B8A8_UNORM:
        case VK_FORMAT_R8G8B8A8_SRGB:
        case VK_FORMAT_B8G8R8A8_UNORM:
        case VK_FORMAT_R16G16_SNORM:
        case VK_FORMAT_R16G16_UNORM:
        case VK_FORMAT_R32_SFLOAT:
        case VK_FORMAT_R32_UINT:
        case VK_FORMAT_D32_SFLOAT:
            return 4;
        case VK_FORMAT_R16G16B16A16_SFLOAT:
            return 8;
        case VK_FORMAT_R32G32B32A32_SFLOAT:
        case VK_FORMAT_R32G32B32A32_UINT:
            return 16;
        default:
            AG_CHECK_MSG(false, "a format without a row in texelSizeBytes");
    }
    return 0;
}

}  // namespace ag::gpu
