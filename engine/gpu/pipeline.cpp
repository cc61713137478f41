#include "engine/gpu/pipeline.h"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "engine/core/failure.h"
#include "engine/core/hash.h"
#include "engine/gpu/context.h"
#include "engine/gpu/raster_pipeline.h"

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
        hash = r.spec[i].hash(hash);
    return combineHash(hash, r.neededCount);
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
    // The row first: if that throws, no module leaks.
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

bool declares(const ShaderModule& module, uint32_t id) {
    return std::ranges::find(module.specConstants, id, &SpecConstantInfo::id) != module.specConstants.end();
}

bool isInteger(ScalarKind kind) {
    return kind == ScalarKind::kInt || kind == ScalarKind::kUint;
}

bool fits(const SpecConstant& given, const SpecConstantInfo& declared) {
    return given.name.text == declared.name &&
           (given.kind == declared.kind || (isInteger(given.kind) && isInteger(declared.kind)));
}

// The value given last counts: a draw's variant over the pass's own.
const SpecConstant* find(const PipelineRequest& request, const SpecConstantInfo& declared) {
    const SpecConstant* found = nullptr;
    for (uint32_t i = 0; i < request.specCount; ++i)
        if (fits(request.spec[i], declared)) found = &request.spec[i];
    return found;
}

// Each constant that is needed must be one of a stage's, with its type.
void checkConstants(const PipelineRequest& request, std::initializer_list<const ShaderModule*> stages) {
    for (uint32_t i = 0; i < request.neededCount; ++i) {
        const SpecConstant& given = request.spec[i];
        const bool known = std::ranges::any_of(stages, [&](const ShaderModule* stage) {
            return std::ranges::any_of(stage->specConstants,
                                       [&](const auto& declared) { return fits(given, declared); });
        });
        if (!known)
            fail(FailureKind::kMistake, (*stages.begin())->path + " has no constant " +
                                            std::string(given.name.text) + " of that type");
    }
}

// The request's constants and the device's own, as far as a shader declares them.
struct Specialization {
    std::array<VkSpecializationMapEntry, kMaxSpecConstants + 5> entries{};
    std::array<uint32_t, kMaxSpecConstants + 5> values{};
    VkSpecializationInfo info{};

    Specialization(const PipelineRequest& request, const ShaderModule& module, const DeviceInfo& device) {
        uint32_t count = 0;
        const auto add = [&](uint32_t id, uint32_t value) {
            entries[count] = {id, count * 4, 4};
            values[count++] = value;
        };
        for (const SpecConstantInfo& declared : module.specConstants) {
            if (declared.id == kSpecSubgroupSize) add(declared.id, device.subgroupSize);
            if (declared.id == kSpecLaneParallel) add(declared.id, device.isCpu);
            if (declared.id == kSpecLanes) add(declared.id, device.lanes.count);
            if (declared.id == kSpecSharedLanes) add(declared.id, device.lanes.shared);
            if (declared.id == kSpecOrderedSubgroups) add(declared.id, device.isCpu);
            if (const SpecConstant* given = find(request, declared)) add(declared.id, given->value);
        }
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
    checkConstants(request, {&compute.module});
    const Specialization specialization(request, compute.module, context.info());
    VkComputePipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
                                     .stage = stageInfo(compute.handle, compute.module, specialization),
                                     .layout = pipeline.layout};
    const VkPipelineShaderStageRequiredSubgroupSizeCreateInfo size{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_REQUIRED_SUBGROUP_SIZE_CREATE_INFO,
        .requiredSubgroupSize = context.info().lanes.count};
    if (context.info().lanes.requested && declares(compute.module, kSpecLanes)) {
        info.stage.pNext = &size;
        info.stage.flags = VK_PIPELINE_SHADER_STAGE_CREATE_REQUIRE_FULL_SUBGROUPS_BIT;
    }
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
    const uint64_t shadersHash = combineHash(vertex.hash, hasFragment ? fragment.hash : 0);
    makeLayout(pipeline, shadersHash, fragment.module.path);
    pipeline.bindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    pipeline.id = combineHash(shadersHash, requestHash(request));
    checkConstants(request, {&fragment.module, &vertex.module});
    const Specialization vertexConstants(request, vertex.module, context.info());
    const Specialization fragmentConstants(request, fragment.module, context.info());
    const VkPipelineShaderStageCreateInfo stages[] = {
        stageInfo(vertex.handle, vertex.module, vertexConstants),
        stageInfo(fragment.handle, fragment.module, fragmentConstants)};
    pipeline.handle =
        makeRasterPipeline(context, request.raster, std::span(stages, hasFragment ? 2 : 1), pipeline.layout);
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
    // The row first, as in shader().
    std::unique_ptr<Pipeline>& row = impl_->pipelines[hash];
    if (row && row->handle) return *row;
    row = std::make_unique<Pipeline>();
    if (!request.computeShader.empty())
        impl_->makeCompute(request, *row);
    else
        impl_->makeRaster(request, *row);
    return *row;
}

}  // namespace ag::gpu
