#include "engine/gpu/pipeline.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <map>
#include <unordered_map>

#include "engine/core/failure.h"
#include "engine/core/hash.h"
#include "engine/gpu/context.h"

namespace ag::gpu {
namespace {

uint64_t requestHash(const PipelineRequest& r) {
    uint64_t hash = hashText(r.computeShader);
    hash = hashText(r.vertexShader, hash);
    hash = hashText(r.fragmentShader, hash);
    const RasterState& s = r.raster;
    for (uint64_t field : {uint64_t(s.vertexLayout), uint64_t(s.cull), uint64_t(s.mirrored),
                           uint64_t(s.blend), uint64_t(s.depthTest), uint64_t(s.depthWrite),
                           uint64_t(s.depthEqual), uint64_t(s.colorCount), uint64_t(s.depthFormat)})
        hash = combineHash(hash, field);
    hash = hashValue(s.depthBiasSlope, hash);
    for (uint32_t i = 0; i < s.colorCount; ++i)
        hash = combineHash(hash, uint64_t(s.colorFormats[i]));
    for (uint32_t i = 0; i < r.specCount; ++i)
        hash = combineHash(combineHash(hash, r.spec[i].id), r.spec[i].value);
    return hash;
}

struct VertexInput {
    std::array<VkVertexInputBindingDescription, 3> bindings{};
    uint32_t bindingCount = 0;
    std::array<VkVertexInputAttributeDescription, 4> attributes{};
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
    if (uvs) in.bindings[in.bindingCount++] = {1, 36, VK_VERTEX_INPUT_RATE_VERTEX};
    if (whole) {
        in.attributes[in.attributeCount++] = {1, 1, VK_FORMAT_R32G32B32_SFLOAT, 0};
        in.attributes[in.attributeCount++] = {2, 1, VK_FORMAT_R32G32B32A32_SFLOAT, 12};
    }
    if (uvs) in.attributes[in.attributeCount++] = {3, 1, VK_FORMAT_R32G32_SFLOAT, 28};
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

}  // namespace

VkDescriptorType descriptorType(BindingKind kind) {
    switch (kind) {
        case BindingKind::kUniformBuffer:
            return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
        case BindingKind::kStorageBuffer:
            return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        case BindingKind::kUniformTexelBuffer:
            return VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
        case BindingKind::kStorageTexelBuffer:
            return VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
        case BindingKind::kSampledImage:
            return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        case BindingKind::kStorageImage:
            return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    }
    return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

struct PipelineLibrary::Impl {
    struct Shader {
        ShaderModule module;
        VkShaderModule handle = VK_NULL_HANDLE;
        uint64_t hash = 0;
    };
    struct Layout {                                   // descriptor sets and push layout of a set of shaders
        std::array<VkDescriptorSetLayout, 2> sets{};  // the second one null where there is none
        VkPipelineLayout pipeline = VK_NULL_HANDLE;
    };
    Context& context;
    ShaderSource source;
    std::map<std::string, Shader, std::less<>> shaders;
    std::map<uint64_t, Layout> layouts;
    std::unordered_map<uint64_t, std::unique_ptr<Pipeline>> pipelines;  // by request hash

    Shader& shader(std::string_view path);
    bool open(const std::string& path, Shader& shader, std::string* error) const;
    void mergeBindings(Pipeline& pipeline, const Shader& shader) const;
    VkDescriptorSetLayout makeSetLayout(std::span<const ShaderBinding> of, const std::string& name) const;
    void makeLayout(Pipeline& pipeline, uint64_t shadersHash, const std::string& name);
    void makeCompute(const PipelineRequest& request, Pipeline& pipeline);
    void makeRaster(const PipelineRequest& request, Pipeline& pipeline);
};

bool PipelineLibrary::Impl::open(const std::string& path, Shader& shader, std::string* error) const {
    auto loaded = source(context.info().storageTexels ? kStorageTexelShaders + path : path);
    if (!loaded) {
        *error = loaded.error().message;
        return false;
    }
    shader.module = std::move(*loaded);
    shader.hash = hashBytes(std::as_bytes(std::span(shader.module.spirv)));
    const VkShaderModuleCreateInfo info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                        .codeSize = shader.module.spirv.size() * 4,
                                        .pCode = shader.module.spirv.data()};
    AG_VK(context.vk().CreateShaderModule(context.handle(), &info, context.hostAllocation(), &shader.handle));
    context.setDebugName(VK_OBJECT_TYPE_SHADER_MODULE, shader.handle, path);
    return true;
}

PipelineLibrary::Impl::Shader& PipelineLibrary::Impl::shader(std::string_view path) {
    const auto found = shaders.find(path);
    if (found != shaders.end() && found->second.handle) return found->second;
    // Its row is there before the module is: no module is lost where a row cannot be had.
    Shader& made = found != shaders.end() ? found->second : shaders[std::string(path)];
    std::string error;
    if (!open(std::string(path), made, &error)) fail(FailureKind::kMistake, error);
    return made;
}

void PipelineLibrary::Impl::mergeBindings(Pipeline& pipeline, const Shader& shader) const {
    const std::string& path = shader.module.path;
    for (const ShaderBinding& b : shader.module.bindings) {
        if (b.set > 1)
            fail(FailureKind::kMistake, "shader " + path + ": binding " + b.name + " is in a third set");
        std::vector<ShaderBinding>& known = b.set == 0 ? pipeline.bindings : pipeline.drawBindings;
        const auto same = std::ranges::find(known, b.name, &ShaderBinding::name);
        const auto place = std::ranges::find(known, b.binding, &ShaderBinding::binding);
        if (same != known.end() && (same->binding != b.binding || same->kind != b.kind))
            fail(FailureKind::kMistake, "shader " + path + ": binding " + b.name + " differs between stages");
        if (same == known.end() && place != known.end())
            fail(FailureKind::kMistake,
                 "shader " + path + ": bindings " + b.name + " and " + place->name + " share a number");
        if (same == known.end()) {
            known.push_back(b);
        } else {
            same->reads = same->reads || b.reads;
            same->writes = same->writes || b.writes;
        }
    }
    if (shader.module.pushSizeBytes > 0) pipeline.pushStages |= VkShaderStageFlags(shader.module.stage);
    pipeline.pushSizeBytes = std::max(pipeline.pushSizeBytes, shader.module.pushSizeBytes);
}

VkDescriptorSetLayout PipelineLibrary::Impl::makeSetLayout(std::span<const ShaderBinding> of,
                                                           const std::string& name) const {
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const ShaderBinding& b : of)
        bindings.push_back({b.binding, descriptorType(b.kind), 1, VK_SHADER_STAGE_ALL, nullptr});
    const VkDescriptorSetLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                               .bindingCount = uint32_t(bindings.size()),
                                               .pBindings = bindings.data()};
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    AG_VK(context.vk().CreateDescriptorSetLayout(context.handle(), &info, context.hostAllocation(), &layout));
    context.setDebugName(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, layout, name);
    return layout;
}

void PipelineLibrary::Impl::makeLayout(Pipeline& pipeline, uint64_t shadersHash, const std::string& name) {
    Layout& layout = layouts[shadersHash];
    const VkDevice device = context.handle();
    if (!layout.sets[0]) layout.sets[0] = makeSetLayout(pipeline.bindings, name);
    if (!layout.sets[1] && !pipeline.drawBindings.empty())
        layout.sets[1] = makeSetLayout(pipeline.drawBindings, name);
    if (!layout.pipeline) {
        const VkPushConstantRange push{pipeline.pushStages, 0, pipeline.pushSizeBytes};
        const VkPipelineLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                              .setLayoutCount = layout.sets[1] ? 2u : 1u,
                                              .pSetLayouts = layout.sets.data(),
                                              .pushConstantRangeCount = pipeline.pushSizeBytes ? 1u : 0u,
                                              .pPushConstantRanges = &push};
        AG_VK(context.vk().CreatePipelineLayout(device, &info, context.hostAllocation(), &layout.pipeline));
        context.setDebugName(VK_OBJECT_TYPE_PIPELINE_LAYOUT, layout.pipeline, name);
    }
    pipeline.setLayout = layout.sets[0];
    pipeline.drawSetLayout = layout.sets[1];
    pipeline.layout = layout.pipeline;
}

namespace {

// The request's constants and the device's own, as far as a shader declares them.
struct Specialization {
    std::array<VkSpecializationMapEntry, kMaxSpecConstants + 2> entries{};
    std::array<uint32_t, kMaxSpecConstants + 2> values{};
    VkSpecializationInfo info{};

    Specialization(const PipelineRequest& request, const ShaderModule& module, const DeviceInfo& device) {
        uint32_t count = 0;
        const auto add = [&](uint32_t id, uint32_t value) {
            if (std::ranges::find(module.specConstantIds, id) == module.specConstantIds.end()) return;
            entries[count] = {id, count * 4, 4};
            values[count++] = value;
        };
        for (uint32_t i = 0; i < request.specCount; ++i)
            add(request.spec[i].id, request.spec[i].value);
        add(kSpecSubgroupSize, device.subgroupSize);
        add(kSpecLaneParallel, device.isCpu);
        info = {count, entries.data(), count * 4, values.data()};
    }
    Specialization(const Specialization&) = delete;
    Specialization& operator=(const Specialization&) = delete;
};

VkPipelineShaderStageCreateInfo stageInfo(VkShaderModule handle, const ShaderModule& module,
                                          const Specialization& specialization) {
    return {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
            .stage = module.stage,
            .module = handle,
            .pName = "main",
            .pSpecializationInfo = &specialization.info};
}

}  // namespace

void PipelineLibrary::Impl::makeCompute(const PipelineRequest& request, Pipeline& pipeline) {
    const Shader& compute = shader(request.computeShader);
    mergeBindings(pipeline, compute);
    makeLayout(pipeline, compute.hash, compute.module.path);
    pipeline.workgroupSize = compute.module.workgroupSize;
    pipeline.id = combineHash(compute.hash, requestHash(request));
    const Specialization specialization(request, compute.module, context.info());
    const VkComputePipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
                                           .stage = stageInfo(compute.handle, compute.module, specialization),
                                           .layout = pipeline.layout};
    AG_VK(context.vk().CreateComputePipelines(context.handle(), context.pipelineCache(), 1, &info,
                                              context.hostAllocation(), &pipeline.handle));
    context.setDebugName(VK_OBJECT_TYPE_PIPELINE, pipeline.handle, compute.module.path);
}

void PipelineLibrary::Impl::makeRaster(const PipelineRequest& request, Pipeline& pipeline) {
    const Shader& vertex = shader(request.vertexShader);
    const bool hasFragment = !request.fragmentShader.empty();
    const Shader& fragment = hasFragment ? shader(request.fragmentShader) : vertex;
    mergeBindings(pipeline, vertex);
    if (hasFragment) mergeBindings(pipeline, fragment);
    makeLayout(pipeline, combineHash(vertex.hash, hasFragment ? fragment.hash : 0), fragment.module.path);
    pipeline.bindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    pipeline.id =
        combineHash(combineHash(vertex.hash, hasFragment ? fragment.hash : 0), requestHash(request));

    const RasterState& state = request.raster;
    const Specialization vertexConstants(request, vertex.module, context.info());
    const Specialization fragmentConstants(request, fragment.module, context.info());
    const VkPipelineShaderStageCreateInfo stages[] = {
        stageInfo(vertex.handle, vertex.module, vertexConstants),
        stageInfo(fragment.handle, fragment.module, fragmentConstants)};
    const VertexInput in = vertexInput(state.vertexLayout);
    const VkPipelineVertexInputStateCreateInfo vertices{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
        .vertexBindingDescriptionCount = in.bindingCount,
        .pVertexBindingDescriptions = in.bindings.data(),
        .vertexAttributeDescriptionCount = in.attributeCount,
        .pVertexAttributeDescriptions = in.attributes.data()};
    const VkPipelineInputAssemblyStateCreateInfo assembly{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
    const VkPipelineViewportStateCreateInfo viewport{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .scissorCount = 1};
    // Projections turn y over, so glTF's counter-clockwise fronts stay counter-clockwise on screen.
    const VkPipelineRasterizationStateCreateInfo raster{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .cullMode =
            VkCullModeFlags(state.cull == CullMode::kBack ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE),
        .frontFace = state.mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE,
        .depthBiasEnable = state.depthBiasSlope != 0,
        .depthBiasSlopeFactor = state.depthBiasSlope,
        .lineWidth = 1};
    const VkPipelineMultisampleStateCreateInfo samples{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
    const VkPipelineDepthStencilStateCreateInfo depth{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = state.depthTest,
        .depthWriteEnable = state.depthWrite,
        .depthCompareOp = state.depthEqual ? VK_COMPARE_OP_EQUAL : VK_COMPARE_OP_GREATER_OR_EQUAL};
    std::array<VkPipelineColorBlendAttachmentState, kMaxColorTargets> attachments{};
    for (VkPipelineColorBlendAttachmentState& a : attachments)
        a = {.blendEnable = state.blend == BlendMode::kAlpha,
             .srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA,
             .dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
             .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
             .dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
             .colorWriteMask = 0xf};
    const VkPipelineColorBlendStateCreateInfo blend{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = state.colorCount,
        .pAttachments = attachments.data()};
    const VkDynamicState dynamics[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR,
                                       VK_DYNAMIC_STATE_VERTEX_INPUT_BINDING_STRIDE,
                                       VK_DYNAMIC_STATE_FRONT_FACE};
    const VkPipelineDynamicStateCreateInfo dynamic{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
        .dynamicStateCount = state.vertexLayout == VertexLayout::kStrided ? 4u : 2u,
        .pDynamicStates = dynamics};
    const VkPipelineRenderingCreateInfo rendering{.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                                                  .colorAttachmentCount = state.colorCount,
                                                  .pColorAttachmentFormats = state.colorFormats.data(),
                                                  .depthAttachmentFormat = state.depthFormat};
    const VkGraphicsPipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                            .pNext = &rendering,
                                            .stageCount = hasFragment ? 2u : 1u,
                                            .pStages = stages,
                                            .pVertexInputState = &vertices,
                                            .pInputAssemblyState = &assembly,
                                            .pViewportState = &viewport,
                                            .pRasterizationState = &raster,
                                            .pMultisampleState = &samples,
                                            .pDepthStencilState = &depth,
                                            .pColorBlendState = &blend,
                                            .pDynamicState = &dynamic,
                                            .layout = pipeline.layout};
    AG_VK(context.vk().CreateGraphicsPipelines(context.handle(), context.pipelineCache(), 1, &info,
                                               context.hostAllocation(), &pipeline.handle));
    context.setDebugName(VK_OBJECT_TYPE_PIPELINE, pipeline.handle, fragment.module.path);
}

PipelineLibrary::PipelineLibrary(Context& context, ShaderSource source)
    : impl_(new Impl{.context = context, .source = std::move(source)}) {}

PipelineLibrary::~PipelineLibrary() {
    const VkDevice device = impl_->context.handle();
    const VkAllocationCallbacks* host = impl_->context.hostAllocation();
    const Functions& vk = impl_->context.vk();
    for (auto& [hash, pipeline] : impl_->pipelines)
        if (pipeline) vk.DestroyPipeline(device, pipeline->handle, host);
    for (auto& [hash, layout] : impl_->layouts) {
        vk.DestroyPipelineLayout(device, layout.pipeline, host);
        for (const VkDescriptorSetLayout set : layout.sets)
            vk.DestroyDescriptorSetLayout(device, set, host);
    }
    for (auto& [path, shader] : impl_->shaders)
        vk.DestroyShaderModule(device, shader.handle, host);
}

const Pipeline& PipelineLibrary::get(const PipelineRequest& request) {
    const uint64_t hash = requestHash(request);
    // Its row is there before the pipeline is, as in shader().
    std::unique_ptr<Pipeline>& row = impl_->pipelines[hash];
    if (row && row->handle) return *row;
    row = std::make_unique<Pipeline>();
    if (!request.computeShader.empty())
        impl_->makeCompute(request, *row);
    else
        impl_->makeRaster(request, *row);
    return *row;
}

int PipelineLibrary::reloadChanged(std::vector<std::string>* errors) {
    Context& context = impl_->context;
    int changed = 0;
    for (auto& [path, shader] : impl_->shaders) {
        Impl::Shader fresh;
        std::string error;
        if (!impl_->open(path, fresh, &error)) {
            if (errors) errors->push_back(error);
            continue;
        }
        const bool same = fresh.hash == shader.hash;
        context.vk().DestroyShaderModule(context.handle(), same ? fresh.handle : shader.handle,
                                         context.hostAllocation());
        if (same) continue;
        shader = std::move(fresh);
        ++changed;
    }
    if (changed == 0) return 0;
    for (auto& [hash, pipeline] : impl_->pipelines)
        context.retire([&context, handle = pipeline->handle] {
            context.vk().DestroyPipeline(context.handle(), handle, context.hostAllocation());
        });
    impl_->pipelines.clear();  // layouts stay: descriptor sets made from them live on
    return changed;
}

size_t PipelineLibrary::size() const {
    return impl_->pipelines.size();
}

}  // namespace ag::gpu
