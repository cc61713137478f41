// SPIR-V with what reflection says of its interface.
#pragma once

#include "engine/gpu/functions.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/core/result.h"

namespace ag::gpu {

enum class BindingKind {
    kUniformBuffer,
    kStorageBuffer,
    kUniformTexelBuffer,
    kStorageTexelBuffer,
    kSampledImage,  // combined image sampler
    kStorageImage,
};

struct ShaderBinding {
    std::string name;  // GLSL name: of the block's instance if it has one, else of the block or variable
    BindingKind kind;
    uint32_t set = 0;
    uint32_t binding = 0;
    bool reads = true;    // false: declared writeonly
    bool writes = false;  // false: declared readonly, or a kind that cannot be written
};

enum class ScalarKind { kBool, kInt, kUint, kFloat };

struct SpecConstantInfo {
    std::string name;
    uint32_t id = 0;
    ScalarKind kind = ScalarKind::kUint;
};

struct StructMember {
    std::string name;
    uint32_t offset = 0;     // bytes
    uint32_t sizeBytes = 0;  // declared size; for a runtime array: its stride
};

struct ShaderStruct {  // for the tests that hold io headers against the compiled shaders
    std::string name;
    std::vector<StructMember> members;
};

struct ShaderModule {
    std::string path;  // "val_clustering/assign_texels.comp"
    VkShaderStageFlagBits stage;
    std::vector<uint32_t> spirv;
    std::vector<ShaderBinding> bindings;
    uint32_t pushSizeBytes = 0;
    glm::uvec3 workgroupSize{1};
    std::vector<SpecConstantInfo> specConstants;
    std::vector<ShaderStruct> structs;
};

// Before the path of a shader that reads storage buffers instead of texel buffers.
const std::string kStorageTexelShaders = "storage/";

// Where shaders come from, by path.
using ShaderSource = std::function<Result<ShaderModule>(const std::string& path)>;

}  // namespace ag::gpu
