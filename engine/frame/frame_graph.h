// The GPU half of "a frame is a build": passes in program order that say what they read and write.
//
// From the declarations the graph derives barriers and image layouts, the memory of transients, and what
// runs:
//  - Every resource has a content version. An import's version comes from outside; the version of a pass's
//    output is a hash of the pass's key (its inputs' versions, push data, draws, pipeline) — as in a build
//    with content keys, and therefore the same from frame to frame when nothing changed.
//  - Backwards from the outputs of the frame: a pass runs if a running pass (or the outside) needs something
//    it writes and the memory does not hold that version already. Otherwise it is `skipped` (contents are
//    current) or `dropped` (nobody needs them).
//  - A history resource is two halves. A pass that writes `current` and reads `previous` is keyed without
//    `previous`; it steps only when the rest of its key changed (or its .step() did). Then the halves swap
//    and the output's version is hash(key, version of previous).
//  - Passes of a scope that is async() go to a second queue where there is one. What waits for what between
//    queues follows from what passes read and write, as barriers do.
//
// Nothing reorders. A steady frame allocates nothing on the heap: names must be string literals or
// outlive the graph, and lists keep their capacity from frame to frame.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/function_ref.h"
#include "engine/frame/pass_builder.h"
#include "engine/frame/pass_counter.h"
#include "engine/gpu/queue.h"

namespace ag {

constexpr uint32_t kFramesInFlight = 2;

namespace gpu {
class Context;
class Image;
}  // namespace gpu

struct FrameDescription;  // frame_description.h

enum class PassOutcome : uint8_t { kRan, kSkipped, kDropped };

// Why.
enum class PassReason : uint8_t {
    kFirst,       // ran: for the first time
    kInput,       // ran: something it reads changed
    kParameters,  // ran: its constants, draws, pipeline or step changed
    kHistory,     // ran: it goes on from the frame before
    kLost,        // ran: what it had made is needed and no longer in memory
    kAll,         // ran: nothing is skipped
    kUnchanged,   // skipped: what it would make is there, or only skipped passes would read it
    kHeld,        // skipped: what it made is to stay (see GraphScope::held)
    kUnread,      // dropped: nothing that was asked for needs what it writes
};

struct PassReport {
    std::string_view name;  // after those of its scopes: "scope/pass"
    PassOutcome outcome = PassOutcome::kDropped;
    PassReason reason = PassReason::kUnread;
    std::string_view changed;  // kInput, kHistory: the first such resource
    double gpuMs = 0;          // of the last frame whose timestamps arrived, 0 if it did not run then
    double cpuMs = 0;          // process CPU time, only in TimingMode::kProcessCpu
    uint64_t runCount = 0;     // since the graph was made
    uint32_t patches = 0, patchesDrawn = 0;  // of a pass of patches or parts, when it ran last
};

std::string_view reasonText(PassReason reason);

// When a pass ran, in ticks of the device's clock (see gpu::Device::readClocks).
struct PassSpan {
    std::string_view name;
    uint64_t beginTicks = 0, endTicks = 0;
};
// The passes that ran in one frame, in order; those of one queue never overlap.
struct FrameSpans {
    uint64_t frame = 0;  // 0: none yet
    std::span<const PassSpan> passes;
    double nsPerTick = 1;
};

enum class TimingMode {
    kTimestamps,  // of every pass; those that overlap share their time
    kBracketed,   // with barriers round every pass, so that its time is its own and the frame takes longer
    kProcessCpu,  // executeAlone(): process CPU time around each pass, the true cost on a CPU device
    kCounts,      // no times: what the device counts in each pass (see counts())
    kOff,
};

// What the graph tells its recorder to do, in order; the null recorder of the tests just keeps these.
struct BarrierRecord {
    std::string_view resource;
    VkPipelineStageFlags2 srcStages, dstStages;
    VkAccessFlags2 srcAccess, dstAccess;
    VkImageLayout oldLayout, newLayout;  // UNDEFINED twice for buffers
};
// Work that is submitted at once. Batches of a queue are submitted in order.
struct QueueBatch {
    gpu::Queue queue = gpu::Queue::kMain;
    VkCommandBuffer commands = VK_NULL_HANDLE;  // begun
    int32_t after = -1;                         // an earlier one, of the other queue, that it waits for
};
// An image becomes the other queue family's: released at the end of one batch, acquired in another.
struct OwnerChange {
    std::string_view resource;
    int32_t from = 0, to = 0;
    bool operator==(const OwnerChange&) const = default;
};
struct PassRecord {
    std::string_view name;
    std::vector<BarrierRecord> barriers;  // before the pass
    int32_t batch = 0;
};

struct FrameGraphOptions {
    bool skip = true;   // engine.skip: false runs every needed pass; images are the same bit for bit
    bool alias = true;  // scratch resources share memory
    std::string_view repeatPass;  // its work is done `repeats` times over: what an optimisation must find
    uint32_t repeats = 1;
    TimingMode timing = TimingMode::kTimestamps;
    bool async = true;  // a second queue is used where there is one; the bits are the same
};

// Where passes and resources are declared: names and all that lasts from frame to frame belong to a scope.
// Views of one graph have a scope each, so that they never meet. A value: hand it on by copy.
class GraphScope {
  public:
    // A scope within this one, the same each time: for passes that are declared once more for something else.
    // `name` as makeScope's. It is reset and removed with this one.
    GraphScope nested(std::string_view name) const;

    // Forgets all that passes of this scope made, histories too: the next frame starts as the first did.
    void reset() const;
    // Forgets one history, e.g. at a camera cut: `valid` is false in the next frame declared.
    void resetHistory(std::string_view name) const;

    // The same scope for passes whose results stay as they are, whatever changes that they read, with
    // skipping or without: for what may be late on purpose. They run only where there is nothing yet.
    GraphScope held(bool on) const;
    bool isHeld() const { return held_; }

    // The same scope for compute passes, fills, uploads and copies of buffers that may run beside the passes
    // of others.
    GraphScope async() const;

    // --- Resources. Names are unique within the scope and a frame, and identify the resource from frame to
    // frame; a changed info makes it anew. ---
    ImageHandle image(std::string_view name, const ImageInfo& info) const;
    BufferHandle buffer(std::string_view name, const BufferInfo& info) const;
    HistoryImage historyImage(std::string_view name, const ImageInfo& info) const;
    HistoryBuffer historyBuffer(std::string_view name, const BufferInfo& info) const;

    // Imports: read-only, owned outside, contents identified by `version` (never 0). `layout` is what the
    // image is in and stays in.
    ImageHandle importImage(std::string_view name, const gpu::Image& image, uint64_t version,
                            VkImageLayout layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL) const;
    BufferHandle importBuffer(std::string_view name, const gpu::Buffer& buffer, uint64_t version) const;
    // The same of what passes may write. The object lives until the frame is recorded.
    ImageHandle borrowImage(std::string_view name, const gpu::Image& image, const Borrowed& how) const;
    BufferHandle borrowBuffer(std::string_view name, const gpu::Buffer& buffer, const Borrowed& how) const;
    // Null-device variants for tests.
    ImageHandle borrowImage(std::string_view name, const ImageInfo& info, const Borrowed& how) const;
    ImageHandle importImage(std::string_view name, const ImageInfo& info, uint64_t version) const;
    BufferHandle importBuffer(std::string_view name, const BufferInfo& info, uint64_t version) const;

    bool isRead(BufferHandle buffer) const;  // by a pass declared so far
    // Whether the pass was asked for in the frame before: what it makes was there at its end.
    bool wasWanted(std::string_view pass) const;
    const ImageInfo& info(ImageHandle image) const;
    const BufferInfo& info(BufferHandle buffer) const;

    // --- Passes; `name` is "technique.step" ---
    PassBuilder compute(std::string_view name, std::string_view shader) const;
    PassBuilder fullscreen(std::string_view name, std::string_view fragmentShader) const;
    PassBuilder raster(std::string_view name, std::string_view vertexShader, std::string_view fragmentShader,
                       gpu::VertexLayout layout) const;
    // Of raster state that is the recorder's own business: see PassBuilder::record.
    PassBuilder callback(std::string_view name) const;
    void fill(std::string_view name, BufferHandle buffer, uint32_t word) const;
    // Host data (some hundred KiB at most, copied now) into a buffer; keyed by its bytes.
    void upload(std::string_view name, BufferHandle buffer, std::span<const std::byte> bytes) const;
    void copyImage(std::string_view name, ImageHandle from,
                   ImageHandle to) const;  // blit with nearest filter if sizes differ

    // Copies a buffer to the CPU when the frame has run and returns what its copy held kFramesInFlight frames
    // ago (the caller has waited for that one's work): nothing stalls. Empty as long as there is none.
    // `names`: of the copies. The span is valid until execute().
    std::span<const std::byte> readBack(const std::array<std::string_view, kFramesInFlight>& names,
                                        BufferHandle buffer) const;

    // What the frame is for: must be current when it ends. An output image is left in `layout`.
    void output(ImageHandle image, VkImageLayout layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL) const;
    void output(BufferHandle buffer) const;

    // By name, null if the frame has none: for --view and captures.
    ImageHandle findImage(std::string_view name) const;
    BufferHandle findBuffer(std::string_view name) const;

    FrameGraph& graph() const { return *graph_; }

  protected:
    GraphScope(FrameGraph& graph, uint32_t id) : graph_(&graph), id_(id) {}

  private:
    friend class FrameGraph;
    friend class PassBuilder;
    FrameGraph* graph_;
    uint32_t id_;
    bool held_ = false;
    bool async_ = false;
};

// Is its own outermost scope.
class FrameGraph : public GraphScope {
  public:
    // Null device and library: nothing is recorded or allocated; barriers, placement and skips are still
    // computed (pipelines then count by shader name).
    FrameGraph(gpu::Context* context, gpu::PipelineLibrary* pipelines);
    ~FrameGraph();  // the device is done with its frames
    FrameGraph(const FrameGraph&) = delete;
    FrameGraph& operator=(const FrameGraph&) = delete;

    // --- Declaring a frame ---
    void beginFrame(const FrameGraphOptions& options);

    // One more scope; `name` (a literal, or outlives the graph) tells its passes and resources from others.
    GraphScope makeScope(std::string_view name);
    void removeScope(const GraphScope& scope);

    // --- Running it ---
    // Another object behind an import, before execute(): for what was made when all passes were declared.
    void rebind(BufferHandle import, const gpu::Buffer& buffer);
    // Decides what runs and records it. `commands` null: decide only (null recorder).
    void execute(VkCommandBuffer commands);
    // The same on two queues, in timing modes in which passes may overlap: `begin` gives more command
    // buffers, begun. Returns what to submit, in this order; the first batch is of the main queue and begins
    // with what `commands` holds already, the last is of the main queue and waits for all others. Valid until
    // the next beginFrame().
    using BeginBatch = FunctionRef<VkCommandBuffer(gpu::Queue)>;
    std::span<const QueueBatch> execute(VkCommandBuffer commands, BeginBatch begin);
    // The same with each pass submitted and waited for by itself, as TimingMode::kProcessCpu asks for:
    // `submit` returns what that took, ms.
    using Submit = FunctionRef<double(const std::function<void(VkCommandBuffer)>& record)>;
    void executeAlone(Submit submit);
    // Instead: makes the pipelines of the passes declared, and nothing else.
    void preparePipelines();
    // Physical resources behind handles of the frame last executed.
    const gpu::Image& physical(ImageHandle image) const;
    const gpu::Buffer& physical(BufferHandle buffer) const;
    VkImageLayout layoutAfterFrame(ImageHandle image) const;
    std::vector<std::string_view> resourceNames() const;

    // --- What happened ---
    std::span<const PassReport> report() const;         // in order, of the frame last executed
    std::span<const PassRecord> nullRecords() const;    // null device only
    std::span<const OwnerChange> ownerChanges() const;  // of the last execute() on two queues
    uint64_t frame() const;                             // number of the frame last begun, from 1
    FrameSpans spans() const;                           // of the last frame whose timestamps arrived
    FrameDescription describe() const;                  // of the frame last executed
    // Of the frame last executed with TimingMode::kCounts: waits for its work. Empty where the device counts
    // nothing (DeviceInfo::counts).
    std::vector<PassCount> counts() const;
    uint64_t transientBytes() const;  // device memory behind the graph's resources
    std::string graphviz() const;

  private:
    friend class GraphScope;
    friend class PassBuilder;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace ag
