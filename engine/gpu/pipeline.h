// Pipelines made from shaders on first request and kept: one per (shaders, specialisation, target formats,
// state).
#pragma once

#include "engine/gpu/functions.h"

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/hash.h"
#include "engine/gpu/shader.h"

namespace ag::gpu {

class Context;

// A constant's name in the shader: a literal, hashed when it is compiled.
struct ConstantName {
    std::string_view text;
    uint64_t hash = 0;

    ConstantName() = default;
    consteval ConstantName(const char* literal) : text(literal) {
        for (const char c : text)
            hash = combineHash(hash, uint8_t(c));
    }
};

// A specialization constant of a pipeline.
struct SpecConstant {
    ConstantName name;
    ScalarKind kind = ScalarKind::kUint;
    uint32_t value = 0;  // bit pattern

    uint64_t hash(uint64_t seed) const {
        return combineHash(combineHash(seed, name.hash), uint64_t(kind) << 32 | value);
    }
};
inline SpecConstant specConstant(ConstantName name, bool value) {
    return {name, ScalarKind::kBool, value};
}
inline SpecConstant specConstant(ConstantName name, float value) {
    return {name, ScalarKind::kFloat, std::bit_cast<uint32_t>(value)};
}
template <class T>
requires std::is_integral_v<T> || std::is_enum_v<T> SpecConstant specConstant(ConstantName name, T value) {
    return {name, ScalarKind::kUint, uint32_t(value)};
}

constexpr size_t kMaxSpecConstants = 8;
constexpr size_t kMaxColorTargets = 4;

// Ids every shader may declare; filled in from the context.
constexpr uint32_t kSpecSubgroupSize = 100;  // uint: lanes of a subgroup
constexpr uint32_t kSpecLaneParallel = 101;  // bool: load one light a lane and shuffle (CPU devices)
// Of workgroups whose lanes exchange values (shaders/common/lanes.glsl):
constexpr uint32_t kSpecLanes = 102;        // uint: invocations
constexpr uint32_t kSpecSharedLanes = 103;  // bool: they do so through shared memory, not as one subgroup
constexpr uint32_t kSpecOrderedSubgroups = 104;  // bool: subgroups sum in the order of their lanes

enum class CullMode : uint32_t { kNone, kBack };
enum class BlendMode : uint32_t { kNone, kAlpha };
enum class VertexLayout : uint32_t {
    kNone,                    // full-screen triangle, vertices from gl_VertexIndex
    kPositions,               // binding 0: vec3 position
    kPositionsAndAttributes,  // + binding 1: vec3 normal, vec4 tangent, vec2 uv, unorm colour (40 bytes)
    kPositionsAndUvs,         // the same without normal and tangent
    kImGui,                   // binding 0: vec2 position, vec2 uv, unorm8x4 colour (20 bytes)
    kStrided,  // bindings 0, 1, 2: vec3 position, vec3 normal, vec2 uv; strides and the front's winding are
               // dynamic
};

struct RasterState {
    VertexLayout vertexLayout = VertexLayout::kNone;
    CullMode cull = CullMode::kNone;
    bool mirrored = false;  // fronts are wound clockwise, as a mirrored instance's are
    BlendMode blend = BlendMode::kNone;
    bool depthTest = false;  // reversed depth: nearer is greater
    bool depthWrite = false;
    bool depthEqual = false;   // passes only what was drawn before at this depth
    float depthBiasSlope = 0;  // for shadow maps; reversed depth, so negative pushes away
    std::array<VkFormat, kMaxColorTargets> colorFormats{};
    uint32_t colorCount = 0;
    VkFormat depthFormat = VK_FORMAT_UNDEFINED;
};

struct PipelineRequest {
    std::string_view computeShader;  // either this,
    std::string_view vertexShader;   // or these two (fragment may be empty: depth only)
    std::string_view fragmentShader;
    RasterState raster;
    std::array<SpecConstant, kMaxSpecConstants> spec{};
    uint32_t specCount = 0;
    uint32_t neededCount = 0;  // the first ones: a stage must have them
};

struct Pipeline {
    VkPipeline handle = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;  // of set 0, which the frame graph binds
    VkDescriptorSetLayout drawSetLayout =
        VK_NULL_HANDLE;  // of set 1, which draws bind by themselves; or null
    VkPipelineBindPoint bindPoint = VK_PIPELINE_BIND_POINT_COMPUTE;
    VkShaderStageFlags pushStages = 0;
    uint32_t pushSizeBytes = 0;
    glm::uvec3 workgroupSize{1};
    std::vector<ShaderBinding> bindings;      // of set 0, of all stages, merged by name
    std::vector<ShaderBinding> drawBindings;  // of set 1
    uint64_t id = 0;                          // identifies shader bytes and state: part of a pass's key
};

VkDescriptorType descriptorType(BindingKind kind);

class PipelineLibrary {
  public:
    PipelineLibrary(Context& context, ShaderSource source);
    ~PipelineLibrary();  // the device is done with its pipelines
    PipelineLibrary(const PipelineLibrary&) = delete;
    PipelineLibrary& operator=(const PipelineLibrary&) = delete;

    // No allocation when the pipeline already exists. Fails (failure.h) with the shader's name if it cannot
    // be made.
    const Pipeline& get(const PipelineRequest& request);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace ag::gpu
