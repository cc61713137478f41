// The one table of how a pass may touch a resource: pipeline stages, access, image layout. Nobody else writes
// a barrier's fields.
#pragma once

#include "engine/gpu/functions.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace ag {

enum class UseKind : uint8_t {
    kComputeRead,  // storage buffer, texel buffer or storage image
    kComputeWrite,
    kComputeReadWrite,
    kComputeSample,  // sampled image
    kRasterRead,     // the same from vertex and fragment shaders
    kRasterSample,
    kColorClear,  // attachments: cleared, or loaded and drawn over
    kColorLoad,
    kDepthClear,
    kDepthLoad,
    kDepthPatch,  // rectangles of it are kept or drawn anew
    kDepthTest,   // read only
    kIndirect,
    kVertices,  // vertex attributes of a raster pass
    kTransferRead,
    kTransferWrite,
    kCount
};

struct Access {
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 reads, writes;
    VkImageLayout layout;  // of images
};

constexpr VkPipelineStageFlags2 kComputeStage = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 kRasterStages =
    VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
constexpr VkPipelineStageFlags2 kColorOutput = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
constexpr VkPipelineStageFlags2 kDepthTests =
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
constexpr VkPipelineStageFlags2 kTransferStage = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
constexpr VkAccessFlags2 kShaderRead = VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_UNIFORM_READ_BIT;
constexpr VkAccessFlags2 kShaderWrite = VK_ACCESS_2_SHADER_WRITE_BIT;
constexpr VkAccessFlags2 kColorRead = VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT;
constexpr VkAccessFlags2 kColorWrite = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
constexpr VkAccessFlags2 kDepthRead = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT;
constexpr VkAccessFlags2 kDepthWrite = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;

constexpr std::array<Access, size_t(UseKind::kCount)> kAccessTable = {{
    {kComputeStage, kShaderRead, 0, VK_IMAGE_LAYOUT_GENERAL},
    {kComputeStage, 0, kShaderWrite, VK_IMAGE_LAYOUT_GENERAL},
    {kComputeStage, kShaderRead, kShaderWrite, VK_IMAGE_LAYOUT_GENERAL},
    {kComputeStage, kShaderRead, 0, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
    {kRasterStages, kShaderRead, 0, VK_IMAGE_LAYOUT_GENERAL},
    {kRasterStages, kShaderRead, 0, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
    {kColorOutput, kColorRead, kColorWrite, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
    {kColorOutput, kColorRead, kColorWrite, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
    {kDepthTests, kDepthRead, kDepthWrite, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL},
    {kDepthTests, kDepthRead, kDepthWrite, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL},
    {kDepthTests, kDepthRead, kDepthWrite, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL},
    {kDepthTests, kDepthRead, 0, VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL},
    {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, 0,
     VK_IMAGE_LAYOUT_UNDEFINED},
    {VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT, VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT, 0,
     VK_IMAGE_LAYOUT_UNDEFINED},
    {kTransferStage, VK_ACCESS_2_TRANSFER_READ_BIT, 0, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL},
    {kTransferStage, 0, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL},
}};

constexpr const Access& accessOf(UseKind kind) {
    return kAccessTable[size_t(kind)];
}

// Whether the pass depends on what the resource held before.
constexpr bool readsOld(UseKind kind) {
    switch (kind) {
        case UseKind::kComputeWrite:
        case UseKind::kColorClear:
        case UseKind::kDepthClear:
        case UseKind::kTransferWrite:
            return false;
        default:
            return true;
    }
}

constexpr bool writes(UseKind kind) {
    return accessOf(kind).writes != 0;
}

}  // namespace ag
