// How a pass is declared: what it reads and writes, its state and constants, its work.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "engine/frame/resource_handles.h"
#include "engine/gpu/pipeline.h"

namespace ag {

namespace gpu {
class Buffer;
}  // namespace gpu

class FrameGraph;
class GraphScope;

// One indexed indirect draw range within a raster pass.
struct RasterDraw {
    std::array<gpu::SpecConstant, 4> spec{};  // the variant: added to the pass's own constants
    uint32_t specCount = 0;
    gpu::CullMode cull = gpu::CullMode::kBack;
    bool mirrored = false;   // see gpu::RasterState
    glm::uvec4 viewport{0};  // x, y, width, height in pixels; all zero: the whole target
    std::array<std::byte, 128> push{};
    uint32_t pushSizeBytes = 0;
    BufferHandle commands;  // VkDrawIndexedIndirectCommand records
    uint64_t commandsOffsetBytes = 0;
    uint32_t commandCount = 0;
    uint64_t commandsVersion = 0;  // version of just this range (0: that of the whole buffer)
    bool beginsPatch = false;      // draws nothing: see PassBuilder::patch
    bool deformed = false;         // of the geometry's deformed vertices
};

// Where a raster pass takes its triangles from.
struct Geometry {
    const gpu::Buffer* positions = nullptr;   // vec3
    const gpu::Buffer* attributes = nullptr;  // vec3 normal, vec4 tangent, vec2 uv; may be null
    const gpu::Buffer* indices = nullptr;     // uint32
    uint64_t version = 0;
    // Vertices that passes write, for draws that ask for them; may be none. Their contents reach the key by
    // the draws' versions.
    BufferHandle deformedPositions, deformedAttributes;
};

// What a pass that records by itself is given.
struct PassRecording {
    VkCommandBuffer commands;
    const gpu::Pipeline* pipeline;  // bound with the pass's descriptor set; null if the pass has no shaders
    glm::uvec2 size;                // pixels of its attachments; viewport and scissor are all of it
};
using PassCallback = std::function<void(const PassRecording&)>;

// Fluent declaration of one pass, whole before the next pass is added.
class PassBuilder {
  public:
    // Bound under their GLSL names. A buffer read binds as SSBO, uniform buffer or texel buffer, whichever
    // the shader declares. Reading, writing and kind are checked against reflection when the pipeline is
    // made.
    PassBuilder& read(std::string_view name, BufferHandle buffer);
    PassBuilder& read(std::string_view name, ImageHandle image);  // storage image
    PassBuilder& write(std::string_view name, BufferHandle buffer);
    PassBuilder& write(std::string_view name, ImageHandle image, uint32_t mip = 0);
    PassBuilder& readWrite(std::string_view name, BufferHandle buffer);
    PassBuilder& readWrite(std::string_view name, ImageHandle image);
    // A part of the buffer that is known to be as `version` says, whatever else in it changes.
    PassBuilder& readPart(std::string_view name, BufferHandle buffer, uint64_t version);
    // The previous half of a history: read, but not part of the key (see the file's head).
    PassBuilder& readPrevious(std::string_view name, const HistoryBuffer& history);
    PassBuilder& samplePrevious(std::string_view name, const HistoryImage& history, Sampler sampler);
    PassBuilder& sample(std::string_view name, ImageHandle image, Sampler sampler = Sampler::kNearestClamp);

    // Attachments, in order of fragment locations. Without a clear value the old contents are loaded.
    PassBuilder& color(ImageHandle image);
    PassBuilder& colorClear(ImageHandle image, glm::vec4 clear);
    PassBuilder& depth(ImageHandle image);
    PassBuilder& depthClear(ImageHandle image, float clear = 0.0f);  // reversed depth: far is 0
    // Only what was drawn into it at the very same depth, by a shader whose position is as invariant.
    PassBuilder& depthEqual(ImageHandle image);
    // An atlas of which each rectangle lasts by itself: only those whose draws changed are cleared and drawn
    // again. Every draw belongs to the patch begun last; patches do not overlap.
    PassBuilder& depthPatches(ImageHandle image, float clear = 0.0f);
    PassBuilder& patch(glm::uvec4 rect);  // x, y, width, height in pixels
    PassBuilder& blend(gpu::BlendMode mode);
    PassBuilder& depthBiasSlope(float slope);

    template <class T>
    PassBuilder& push(const T& value) {
        static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= 128);
        return pushBytes(std::as_bytes(std::span(&value, 1)));
    }
    PassBuilder& pushBytes(std::span<const std::byte> bytes);
    PassBuilder& constant(const gpu::SpecConstant& value);
    template <class T>
    PassBuilder& constant(gpu::ConstantName name, T value) {
        return constant(gpu::specConstant(name, value));
    }
    // For passes with history: a number that advances while the pass is to go on stepping with equal inputs.
    PassBuilder& step(uint64_t value);
    // Anything else the result depends on that the graph cannot see.
    PassBuilder& key(uint64_t value);

    // Exactly one of these for a compute pass.
    PassBuilder& dispatchThreads(uint32_t x, uint32_t y = 1, uint32_t z = 1);
    PassBuilder& dispatchGroups(uint32_t x, uint32_t y = 1, uint32_t z = 1);
    PassBuilder& dispatchIndirect(BufferHandle arguments, uint64_t offsetBytes = 0);
    // Instead: groups whose work lasts by itself. Of what parts() names only those groups are written that
    // have another key than when they were written last; the shader's constants begin with the first group
    // to run. Parts do not overlap.
    PassBuilder& parts(std::string_view name, BufferHandle buffer);
    PassBuilder& part(uint32_t firstGroup, uint32_t groupCount, uint64_t partKey);
    // What the last part is made from, of what the pass reads: its contents are in the part's key.
    PassBuilder& partReads(BufferHandle buffer);
    PassBuilder& partReads(ImageHandle image);
    // Raster passes.
    PassBuilder& geometry(const Geometry& geometry);
    PassBuilder& draw(const RasterDraw& draw);
    // Instead of draws: what the pass does, within its attachments if it has any. What that depends on
    // besides the resources read is told by key(). It may change all state of the command buffer.
    PassBuilder& record(PassCallback callback);

  private:
    friend class GraphScope;
    PassBuilder(FrameGraph& graph, uint32_t pass) : graph_(&graph), pass_(pass) {}
    FrameGraph* graph_;
    uint32_t pass_;  // of this frame's
};

}  // namespace ag
