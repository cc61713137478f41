// Images and buffers as passes name them, and what they are.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "engine/gpu/functions.h"

namespace ag {

struct ImageHandle {
    uint32_t index = ~0u;
    explicit operator bool() const { return index != ~0u; }
    bool operator==(const ImageHandle&) const = default;
};

struct BufferHandle {
    uint32_t index = ~0u;
    explicit operator bool() const { return index != ~0u; }
    bool operator==(const BufferHandle&) const = default;
};

// kKept contents survive the frame, so that an unchanged pass can be skipped. kScratch images share memory
// where their uses do not overlap: contents are made again whenever a running pass needs them.
enum class Lifetime : uint32_t { kKept, kScratch };

struct ImageInfo {
    VkFormat format = VK_FORMAT_UNDEFINED;
    glm::uvec2 size{1};
    uint32_t mips = 1;
    Lifetime lifetime = Lifetime::kKept;
};

struct BufferInfo {
    uint64_t sizeBytes = 0;
    VkFormat texelFormat = VK_FORMAT_UNDEFINED;  // set it to read the buffer as a texel buffer
    bool indirect = false;
    bool vertices = false;     // may be Geometry's
    bool hostVisible = false;  // lies in memory that the CPU reads; for FrameGraph::readBack
};

struct HistoryBuffer {
    BufferHandle current, previous;
    bool valid = false;  // false: `previous` was never written (first frame, resized, reset): it holds zeroes
};
struct HistoryImage {
    ImageHandle current, previous;
    bool valid = false;
};

enum class Sampler : uint32_t {
    kNearestClamp,
    kLinearClamp,
    kLinearRepeat,
    kTrilinearRepeat,
    kAnisotropicRepeat,  // trilinear where the device cannot
};
constexpr size_t kSamplers = 5;

// A host's image or buffer that passes may write. The host is done with it, in any stage, before the graph's
// commands; after them it may use it in any.
struct Borrowed {
    VkImageLayout before = VK_IMAGE_LAYOUT_GENERAL;  // of an image: that it comes in
    VkImageLayout after = VK_IMAGE_LAYOUT_GENERAL;   // that it is left in
    // It holds what the graph left there last. Otherwise it is written anew.
    bool untouched = false;
};

}  // namespace ag
