#include "engine/gpu/raster_pipeline.h"

#include <array>

#include "engine/gpu/context.h"

namespace ag::gpu {
namespace {

struct VertexInput {
    std::array<VkVertexInputBindingDescription, 3> bindings{};
    uint32_t bindingCount = 0;
    std::array<VkVertexInputAttributeDescription, 5> attributes{};
    uint32_t attributeCount = 0;
};

VertexInput vertexInput(VertexLayout layout) {
    VertexInput in;
    const bool whole = layout == VertexLayout::kPositionsAndAttributes;
    const bool uvs = whole || layout == VertexLayout::kPositionsAndUvs;
    if (uvs || layout == VertexLayout::kPositions) {
        in.bindings[in.bindingCount++] = {0, 12, VK_VERTEX_INPUT_RATE_VERTEX};
        in.attributes[in.attributeCount++] = {0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0};
    }
    if (uvs) in.bindings[in.bindingCount++] = {1, 40, VK_VERTEX_INPUT_RATE_VERTEX};
    if (whole) {
        in.attributes[in.attributeCount++] = {1, 1, VK_FORMAT_R32G32B32_SFLOAT, 0};
        in.attributes[in.attributeCount++] = {2, 1, VK_FORMAT_R32G32B32A32_SFLOAT, 12};
    }
    if (uvs) in.attributes[in.attributeCount++] = {3, 1, VK_FORMAT_R32G32_SFLOAT, 28};
    if (whole) in.attributes[in.attributeCount++] = {4, 1, VK_FORMAT_A2B10G10R10_UNORM_PACK32, 36};
    if (layout == VertexLayout::kImGui) {
        in.bindings[in.bindingCount++] = {0, 20, VK_VERTEX_INPUT_RATE_VERTEX};
        in.attributes[in.attributeCount++] = {0, 0, VK_FORMAT_R32G32_SFLOAT, 0};
        in.attributes[in.attributeCount++] = {1, 0, VK_FORMAT_R32G32_SFLOAT, 8};
        in.attributes[in.attributeCount++] = {2, 0, VK_FORMAT_R8G8B8A8_UNORM, 16};
    }
    if (layout == VertexLayout::kStrided) {
        constexpr std::array kFormats = {VK_FORMAT_R32G32B32_SFLOAT, VK_FORMAT_R32G32B32_SFLOAT,
                                         VK_FORMAT_R32G32_SFLOAT};
        for (uint32_t i = 0; i < kFormats.size(); ++i) {
            in.bindings[in.bindingCount++] = {i, 0, VK_VERTEX_INPUT_RATE_VERTEX};
            in.attributes[in.attributeCount++] = {i, i, kFormats[i], 0};
        }
    }
    return in;
}

VkPipelineVertexInputStateCreateInfo infoOf(const VertexInput& in) {
    return {.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
            .vertexBindingDescriptionCount = in.bindingCount,
            .pVertexBindingDescriptions = in.bindings.data(),
            .vertexAttributeDescriptionCount = in.attributeCount,
            .pVertexAttributeDescriptions = in.attributes.data()};
}

// Projections turn y over, so glTF's counter-clockwise fronts stay counter-clockwise on screen.
VkPipelineRasterizationStateCreateInfo rasterization(const RasterState& state) {
    return {.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
            .cullMode =
                VkCullModeFlags(state.cull == CullMode::kBack ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE),
            .frontFace = state.mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE,
            .depthBiasEnable = state.depthBiasSlope != 0,
            .depthBiasSlopeFactor = state.depthBiasSlope,
            .lineWidth = 1};
}

VkPipelineDepthStencilStateCreateInfo depthTest(const RasterState& state) {
    return {.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
            .depthTestEnable = state.depthTest,
            .depthWriteEnable = state.depthWrite,
            .depthCompareOp = state.depthEqual ? VK_COMPARE_OP_EQUAL : VK_COMPARE_OP_GREATER_OR_EQUAL};
}

VkPipelineColorBlendAttachmentState blending(BlendMode mode) {
    return {.blendEnable = mode == BlendMode::kAlpha,
            .srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA,
            .dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
            .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
            .dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
            .colorWriteMask = 0xf};
}

VkPipelineDynamicStateCreateInfo dynamicState(VertexLayout layout) {
    static constexpr std::array kStates = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR,
                                           VK_DYNAMIC_STATE_VERTEX_INPUT_BINDING_STRIDE,
                                           VK_DYNAMIC_STATE_FRONT_FACE};
    return {.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
            .dynamicStateCount = layout == VertexLayout::kStrided ? 4u : 2u,
            .pDynamicStates = kStates.data()};
}

constexpr VkPipelineInputAssemblyStateCreateInfo kTriangles{
    .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
    .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
constexpr VkPipelineViewportStateCreateInfo kOneViewport{
    .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO, .viewportCount = 1, .scissorCount = 1};
constexpr VkPipelineMultisampleStateCreateInfo kOneSample{
    .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
    .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};

}  // namespace

VkPipeline makeRasterPipeline(Context& context, const RasterState& state,
                              std::span<const VkPipelineShaderStageCreateInfo> stages,
                              VkPipelineLayout layout) {
    const VertexInput in = vertexInput(state.vertexLayout);
    const VkPipelineVertexInputStateCreateInfo vertices = infoOf(in);
    const VkPipelineRasterizationStateCreateInfo raster = rasterization(state);
    const VkPipelineDepthStencilStateCreateInfo depth = depthTest(state);
    std::array<VkPipelineColorBlendAttachmentState, kMaxColorTargets> attachments{};
    attachments.fill(blending(state.blend));
    const VkPipelineColorBlendStateCreateInfo blend{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = state.colorCount,
        .pAttachments = attachments.data()};
    const VkPipelineDynamicStateCreateInfo dynamic = dynamicState(state.vertexLayout);
    const VkPipelineRenderingCreateInfo rendering{.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                                                  .colorAttachmentCount = state.colorCount,
                                                  .pColorAttachmentFormats = state.colorFormats.data(),
                                                  .depthAttachmentFormat = state.depthFormat};
    const VkGraphicsPipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                            .pNext = &rendering,
                                            .stageCount = uint32_t(stages.size()),
                                            .pStages = stages.data(),
                                            .pVertexInputState = &vertices,
                                            .pInputAssemblyState = &kTriangles,
                                            .pViewportState = &kOneViewport,
                                            .pRasterizationState = &raster,
                                            .pMultisampleState = &kOneSample,
                                            .pDepthStencilState = &depth,
                                            .pColorBlendState = &blend,
                                            .pDynamicState = &dynamic,
                                            .layout = layout};
    VkPipeline pipeline = VK_NULL_HANDLE;
    AG_VK(context.vk().CreateGraphicsPipelines(context.handle(), context.pipelineCache(), 1, &info,
                                               context.hostAllocation(), &pipeline));
    return pipeline;
}

}  // namespace ag::gpu
