// What a SPIR-V module binds, through SPIRV-Cross.
#include <spirv_cross/spirv_cross_c.h>

#include <algorithm>
#include <memory>

#include "engine/gpu/shader_files.h"

namespace ag::gpu {
namespace {

struct ReflectionDelete {
    void operator()(spvc_context c) const { spvc_context_destroy(c); }
};
using Reflection = std::unique_ptr<spvc_context_s, ReflectionDelete>;

struct KindRow {
    spvc_resource_type resource;
    BindingKind kind;
};

constexpr KindRow kKinds[] = {{SPVC_RESOURCE_TYPE_UNIFORM_BUFFER, BindingKind::kUniformBuffer},
                              {SPVC_RESOURCE_TYPE_STORAGE_BUFFER, BindingKind::kStorageBuffer},
                              {SPVC_RESOURCE_TYPE_SAMPLED_IMAGE, BindingKind::kSampledImage},
                              {SPVC_RESOURCE_TYPE_STORAGE_IMAGE, BindingKind::kStorageImage},
                              {SPVC_RESOURCE_TYPE_SEPARATE_IMAGE, BindingKind::kUniformTexelBuffer}};

bool hasDecoration(spvc_compiler compiler, const spvc_reflected_resource& r, SpvDecoration decoration) {
    if (spvc_compiler_has_decoration(compiler, r.id, decoration)) return true;
    // glslang puts the decorations of a block on its members.
    const spvc_type type = spvc_compiler_get_type_handle(compiler, r.base_type_id);
    const unsigned members = spvc_type_get_num_member_types(type);
    for (unsigned i = 0; i < members; ++i)
        if (!spvc_compiler_has_member_decoration(compiler, r.base_type_id, i, decoration)) return false;
    return members > 0;
}

BindingKind kindOf(spvc_compiler compiler, const spvc_reflected_resource& r, BindingKind listed) {
    const spvc_type type = spvc_compiler_get_type_handle(compiler, r.type_id);
    const bool image = listed == BindingKind::kSampledImage || listed == BindingKind::kStorageImage ||
                       listed == BindingKind::kUniformTexelBuffer;
    if (!image || spvc_type_get_image_dimension(type) != SpvDimBuffer) return listed;
    return listed == BindingKind::kStorageImage ? BindingKind::kStorageTexelBuffer
                                                : BindingKind::kUniformTexelBuffer;
}

void addBindings(spvc_compiler compiler, spvc_resources resources, const KindRow& row, ShaderModule& module) {
    const spvc_reflected_resource* list = nullptr;
    size_t count = 0;
    spvc_resources_get_resource_list_for_type(resources, row.resource, &list, &count);
    for (size_t i = 0; i < count; ++i) {
        const spvc_reflected_resource& r = list[i];
        ShaderBinding binding;
        const char* instance =
            spvc_compiler_get_name(compiler, r.id);  // of the variable; r.name is the block's
        binding.name = instance && *instance ? instance : r.name;
        binding.kind = kindOf(compiler, r, row.kind);
        binding.set = spvc_compiler_get_decoration(compiler, r.id, SpvDecorationDescriptorSet);
        binding.binding = spvc_compiler_get_decoration(compiler, r.id, SpvDecorationBinding);
        const bool writable = binding.kind == BindingKind::kStorageBuffer ||
                              binding.kind == BindingKind::kStorageImage ||
                              binding.kind == BindingKind::kStorageTexelBuffer;
        binding.writes = writable && !hasDecoration(compiler, r, SpvDecorationNonWritable);
        binding.reads = !hasDecoration(compiler, r, SpvDecorationNonReadable);
        module.bindings.push_back(std::move(binding));
    }
}

// The struct type and all struct types inside it, each name once.
void addStructs(spvc_compiler compiler, spvc_type_id id, ShaderModule& module) {
    const spvc_type type = spvc_compiler_get_type_handle(compiler, id);
    if (spvc_type_get_basetype(type) != SPVC_BASETYPE_STRUCT) return;
    const spvc_type_id base = spvc_type_get_base_type_id(type);
    ShaderStruct s{.name = spvc_compiler_get_name(compiler, base)};
    for (const ShaderStruct& known : module.structs)
        if (known.name == s.name) return;
    const unsigned members = spvc_type_get_num_member_types(type);
    for (unsigned i = 0; i < members; ++i) {
        unsigned offset = 0;
        size_t size = 0;
        spvc_compiler_type_struct_member_offset(compiler, type, i, &offset);
        spvc_compiler_get_declared_struct_member_size(compiler, type, i, &size);
        s.members.push_back({spvc_compiler_get_member_name(compiler, base, i), offset, uint32_t(size)});
    }
    module.structs.push_back(std::move(s));
    for (unsigned i = 0; i < members; ++i)
        addStructs(compiler, spvc_type_get_member_type(type, i), module);
}

void addBlocks(spvc_compiler compiler, spvc_resources resources, spvc_resource_type kind,
               ShaderModule& module) {
    const spvc_reflected_resource* list = nullptr;
    size_t count = 0;
    spvc_resources_get_resource_list_for_type(resources, kind, &list, &count);
    for (size_t i = 0; i < count; ++i) {
        addStructs(compiler, list[i].base_type_id, module);
        if (kind != SPVC_RESOURCE_TYPE_PUSH_CONSTANT) continue;
        size_t size = 0;
        spvc_compiler_get_declared_struct_size(
            compiler, spvc_compiler_get_type_handle(compiler, list[i].base_type_id), &size);
        module.pushSizeBytes = uint32_t(size);
    }
}

VkShaderStageFlagBits stageOf(spvc_compiler compiler) {
    switch (spvc_compiler_get_execution_model(compiler)) {
        case SpvExecutionModelVertex:
            return VK_SHADER_STAGE_VERTEX_BIT;
        case SpvExecutionModelFragment:
            return VK_SHADER_STAGE_FRAGMENT_BIT;
        default:
            return VK_SHADER_STAGE_COMPUTE_BIT;
    }
}

ScalarKind kindOf(spvc_basetype type) {
    switch (type) {
        case SPVC_BASETYPE_BOOLEAN:
            return ScalarKind::kBool;
        case SPVC_BASETYPE_FP32:
            return ScalarKind::kFloat;
        case SPVC_BASETYPE_INT32:
            return ScalarKind::kInt;
        default:
            return ScalarKind::kUint;
    }
}

// A constant that gives a workgroup's size is listed once more, without its name.
void addConstant(spvc_compiler compiler, const spvc_specialization_constant& constant, ShaderModule& module) {
    const auto known = std::ranges::find(module.specConstants, constant.constant_id, &SpecConstantInfo::id);
    const std::string name = spvc_compiler_get_name(compiler, constant.id);
    if (known != module.specConstants.end()) {
        if (known->name.empty()) known->name = name;
        return;
    }
    const spvc_type type = spvc_compiler_get_type_handle(
        compiler, spvc_constant_get_type(spvc_compiler_get_constant_handle(compiler, constant.id)));
    module.specConstants.push_back({name, constant.constant_id, kindOf(spvc_type_get_basetype(type))});
}

}  // namespace

Result<ShaderModule> reflectShader(std::string path, std::vector<uint32_t> spirv) {
    spvc_context raw = nullptr;
    if (spvc_context_create(&raw) != SPVC_SUCCESS) return Error{"SPIRV-Cross cannot start"};
    const Reflection context(raw);
    const auto fail = [&] {
        return Error{"shader " + path + ": " + spvc_context_get_last_error_string(raw)};
    };
    spvc_parsed_ir ir = nullptr;
    spvc_compiler compiler = nullptr;
    spvc_resources resources = nullptr;
    if (spvc_context_parse_spirv(raw, spirv.data(), spirv.size(), &ir) != SPVC_SUCCESS) return fail();
    if (spvc_context_create_compiler(raw, SPVC_BACKEND_NONE, ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP,
                                     &compiler) != SPVC_SUCCESS)
        return fail();
    if (spvc_compiler_create_shader_resources(compiler, &resources) != SPVC_SUCCESS) return fail();

    ShaderModule module{.path = std::move(path), .stage = stageOf(compiler), .spirv = std::move(spirv)};
    for (const KindRow& row : kKinds)
        addBindings(compiler, resources, row, module);
    addBlocks(compiler, resources, SPVC_RESOURCE_TYPE_STORAGE_BUFFER, module);
    addBlocks(compiler, resources, SPVC_RESOURCE_TYPE_UNIFORM_BUFFER, module);
    addBlocks(compiler, resources, SPVC_RESOURCE_TYPE_PUSH_CONSTANT, module);
    if (module.stage == VK_SHADER_STAGE_COMPUTE_BIT)
        for (uint32_t axis = 0; axis < 3; ++axis)
            module.workgroupSize[int(axis)] =
                spvc_compiler_get_execution_mode_argument_by_index(compiler, SpvExecutionModeLocalSize, axis);
    const spvc_specialization_constant* constants = nullptr;
    size_t count = 0;
    spvc_compiler_get_specialization_constants(compiler, &constants, &count);
    for (size_t i = 0; i < count; ++i)
        addConstant(compiler, constants[i], module);
    return module;
}

}  // namespace ag::gpu
