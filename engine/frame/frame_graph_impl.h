// The frame graph's inside: what a frame declares, what lasts from frame to frame. Shared by the files beside
// it only.
#pragma once

#include <deque>
#include <string>
#include <unordered_map>

#include "engine/core/check.h"
#include "engine/core/hash.h"
#include "engine/frame/access.h"
#include "engine/frame/frame_graph.h"
#include "engine/frame/frame_timer.h"
#include "engine/gpu/context.h"
#include "engine/gpu/resources.h"

namespace ag {

// What is known of the device's accesses to one piece of memory, also across frames.
struct SyncState {
    VkPipelineStageFlags2 writeStages = 0;
    VkAccessFlags2 writeAccess = 0;
    VkPipelineStageFlags2 readStages = 0;     // since that write
    VkPipelineStageFlags2 visibleStages = 0;  // where that write can be seen
    VkAccessFlags2 visibleAccess = 0;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
};
// Of memory that the other queue changed: what uses it has waited for a semaphore, at all stages. A change of
// layout must name a stage of that wait to come after it. The accesses are named although the semaphore
// covers them, because validation does not follow timelines.
inline SyncState stateForOther(VkImageLayout layout) {
    return {.writeStages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
            .writeAccess = VK_ACCESS_2_MEMORY_WRITE_BIT,
            .readStages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
            .layout = layout};
}
// Of memory that others used before: all of their work, and no contents.
inline constexpr SyncState kTakenOver{.writeStages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                      .writeAccess = VK_ACCESS_2_MEMORY_WRITE_BIT,
                                      .readStages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};

// A rectangle of an atlas and what was drawn there.
struct Patch {
    glm::uvec4 rect;
    uint64_t key = 0;
};

// Groups of a dispatch and what they were made from.
struct GroupPart {
    uint32_t firstGroup = 0, groupCount = 0;
    uint64_t key = 0;
    bool operator==(const GroupPart&) const = default;
};

// A part, and a resource that it is made from.
struct PartSource {
    uint32_t part = 0, resource = 0;
};

// One image or buffer with what it holds.
struct Memory {
    std::unique_ptr<gpu::Image> image;
    std::unique_ptr<gpu::Buffer> buffer;
    const gpu::Image* borrowedImage = nullptr;  // instead: a host's, of this frame
    const gpu::Buffer* borrowedBuffer = nullptr;
    std::array<SyncState, gpu::kQueues> sync;  // of each queue's accesses
    gpu::Queue owner = gpu::Queue::kMain;      // of an image, where queues are of two families
    // Batches of each queue that used and changed it last, in frame `usedFrame`.
    uint64_t usedFrame = 0;
    std::array<int32_t, gpu::kQueues> lastUse{-1, -1}, lastChange{-1, -1};
    uint64_t version = 0;      // of the contents; 0: nothing
    uint64_t stepVersion = 0;  // the same without what histories were before
    bool needsZero = false;    // histories start as zeroes
    std::vector<Patch> patches;
    std::vector<GroupPart> parts;
};

inline const gpu::Image* imageIn(const Memory& memory) {
    return memory.borrowedImage ? memory.borrowedImage : memory.image.get();
}
inline const gpu::Buffer* bufferIn(const Memory& memory) {
    return memory.borrowedBuffer ? memory.borrowedBuffer : memory.buffer.get();
}

// Memory that scratch images share.
struct AliasBucket {
    gpu::MemoryRange range;
    VkMemoryRequirements requirements{};
    uint32_t lastUser = ~0u;  // slot whose image was used last
    uint32_t busyUntil = 0;   // while placing: the last pass that uses it
    std::vector<uint32_t> slots;
};

// What a name of a scope stands for from frame to frame. Histories have two halves, others use the first.
struct Slot {
    uint32_t scope = 0;
    std::string name;
    bool isImage = false, isHistory = false;
    ImageInfo image;
    BufferInfo buffer;
    std::array<Memory, 2> halves;
    uint32_t current = 0;    // half that holds the newest contents
    uint64_t stepKey = 0;    // of the step that made them
    uint64_t lastFrame = 0;  // declared last in
    uint32_t bucket = ~0u;   // of a scratch image
    bool fresh = true;       // has no device objects for its info yet
    bool async = false;      // shares no memory: used on the second queue
};

enum class ResourceKind : uint8_t { kOwned, kHistoryPrevious, kImport };

// A resource as this frame declares it.
struct Resource {
    std::string_view name;
    uint32_t scope = 0;
    ResourceKind kind = ResourceKind::kOwned;
    bool isImage = false;
    ImageInfo image;
    BufferInfo buffer;
    uint32_t slot = ~0u;  // of owned resources
    uint32_t half = 0;    // which of the slot's memories, decided while planning
    const gpu::Image* importedImage = nullptr;
    const gpu::Buffer* importedBuffer = nullptr;
    uint64_t importVersion = 0;
    bool isOutput = false;
    VkImageLayout outputLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    // Planning
    uint64_t version = 0;    // at the current point of the walk
    bool needed = false;     // the version at the current point is needed by something that runs
    bool wanted = false;     // or is by something reachable from the outputs
    bool clobbered = false;  // a running pass writes it
    uint32_t firstPass = ~0u, lastPass = 0;
    bool async = false;  // used on the second queue
};

struct Use {
    uint32_t resource = 0;
    UseKind kind = UseKind::kComputeRead;
    std::string_view name;  // binding; empty for attachments and the like
    Sampler sampler = Sampler::kNearestClamp;
    uint32_t mip = 0;
    bool wholeImage = true;
    bool previous = false;  // half of a history: not part of the step's key
    bool keyed = true;      // false: its version reaches the key another way
    glm::vec4 clear{0};
    uint64_t versionBefore = 0, versionAfter = 0;  // of what it reads, of what it writes
    uint64_t stepVersionAfter = 0;                 // see Memory
};

enum class PassKind : uint8_t {
    kCompute,
    kFullscreen,
    kRaster,
    kCallback,
    kFill,
    kUpload,
    kCopyImage,
    kCopyBuffer
};

struct Pass {
    std::string_view name, shader, vertexShader;
    PassKind kind = PassKind::kCompute;
    uint32_t firstUse = 0, useCount = 0;
    uint32_t firstDraw = 0, drawCount = 0;
    uint32_t firstPart = 0, partCount = 0;
    gpu::RasterState raster;
    std::array<gpu::SpecConstant, gpu::kMaxSpecConstants> spec{};
    uint32_t specCount = 0;
    std::array<std::byte, 128> push{};
    uint32_t pushSizeBytes = 0;
    uint64_t extraKey = 0;
    bool threads = false;  // the dispatch counts threads, not groups
    glm::uvec3 dispatch{0};
    bool dispatchIndirect = false;
    uint64_t indirectOffset = 0;
    Geometry geometry;
    uint32_t callback = ~0u;  // of FrameGraph::Impl::callbacks
    uint32_t fillWord = 0;
    uint32_t dataOffset = 0, dataSize = 0;  // upload bytes
    // Planning
    const gpu::Pipeline* pipeline = nullptr;
    uint64_t pipelineKey = 0;
    bool runs = false, wanted = false;
    bool held = false;   // what it writes stays as it is
    bool async = false;  // may run on the second queue
    uint32_t stats = 0;
};

struct PassStats {
    uint64_t nameHash = 0;  // of scope and name
    uint32_t scope = 0;
    std::unique_ptr<const std::string> fullName;  // stays where it is; none: the scope is no more
    double gpuMs = 0, cpuMs = 0;
    uint64_t runCount = 0;
    uint64_t wantedIn = 0;         // number of the last frame in which it was not dropped
    uint64_t checkedPipeline = 0;  // bindings were checked against it
    // When it ran last:
    uint64_t ownKey = 0;
    std::vector<uint64_t> inputVersions;  // by use
    uint32_t patches = 0, patchesDrawn = 0;
};

struct Scope {
    std::string_view name;  // of the outermost: empty
    bool used = true;
    uint32_t parent = ~0u;  // of a nested one
};

// How a frame is being split between queues (frame_graph_queues.cpp).
struct Batches {
    static constexpr int32_t kNone = -1;
    const FrameGraph::BeginBatch* begin = nullptr;  // none: all goes to one command buffer
    std::vector<QueueBatch> all;
    // By queue: the batch that its passes go to now, and the last of the other queue that it waited for.
    std::array<int32_t, gpu::kQueues> open{kNone, kNone}, waited{kNone, kNone};
    gpu::Queue queue = gpu::Queue::kMain;  // of the pass being recorded
    std::vector<OwnerChange> ownerChanges;
};

// What the outermost scope's names hash to is what they would without scopes.
inline uint64_t hashName(uint32_t scope, std::string_view name) {
    return hashText(name, scope);
}

struct FrameGraph::Impl {
    gpu::Context* context = nullptr;
    gpu::PipelineLibrary* pipelines = nullptr;
    FrameGraphOptions options;
    uint64_t frame = 0;

    // This frame
    std::vector<Resource> resources;
    std::vector<Pass> passes;
    std::vector<Use> uses;
    std::vector<RasterDraw> draws;
    std::vector<GroupPart> parts;
    std::vector<PartSource> partSources;  // in the parts' order
    std::vector<std::byte> data;
    std::vector<PassCallback> callbacks;
    uint64_t framesRun = 0;
    std::vector<PassReport> report;
    std::vector<PassRecord> records;
    std::vector<PassSpan> spans;  // of frame `spansFrame`
    uint64_t spansFrame = 0;
    std::vector<uint64_t> stepKeys;   // scratch, by slot
    std::vector<uint32_t> heldSlots;  // scratch: histories that do not step
    std::vector<Patch> patches;       // scratch

    // From frame to frame
    std::vector<Scope> scopes = std::vector<Scope>(1);
    std::vector<Slot> slots;
    std::unordered_map<uint64_t, uint32_t> slotOfName;
    std::vector<PassStats> stats;
    std::unordered_map<uint64_t, uint32_t> statsOfName;
    std::vector<AliasBucket> buckets;
    bool bucketsStale = false;
    bool placedAliased = true;  // options.alias when scratch was placed
    std::array<VkSampler, kSamplers> samplers{};
    std::unordered_map<uint64_t, VkDescriptorSet> sets;
    std::vector<VkDescriptorPool> pools;
    std::unique_ptr<FrameTimer> timer;     // made when passes are timed first
    std::unique_ptr<PassCounter> counter;  // made when they are counted first
    Batches batches;
    std::vector<VkImageMemoryBarrier2> imageBarriers;    // scratch
    std::vector<VkBufferMemoryBarrier2> bufferBarriers;  // scratch

    // Declaring (frame_graph.cpp)
    uint32_t declare(Resource resource, bool history);
    uint32_t declareHistory(Resource resource);
    uint32_t import(Resource resource);
    Memory& borrow(uint32_t resource, const Borrowed& how);
    uint32_t find(uint32_t scope, bool isImage, std::string_view name) const;
    uint32_t addPass(const GraphScope& scope, std::string_view name, PassKind kind);
    Pass& declaring(uint32_t pass);
    void addUse(uint32_t pass, const Use& use);
    uint32_t statsFor(uint32_t scope, std::string_view name);
    void forget(Slot& slot);
    std::string fullName(uint32_t scope, std::string_view name) const;

    // Planning (frame_graph_plan.cpp)
    void plan();
    void resolvePipelines();
    uint64_t ownKey(const Pass& pass) const;
    uint64_t passKey(const Pass& pass, bool withPrevious) const;
    void decideHeld();
    const Memory& newest(const Resource& resource) const;
    const Use* earlierWrite(const Pass& pass, const Use& use) const;
    void walkVersions(bool withPrevious);
    void keyParts();
    void addPartSource(uint32_t resource) {  // of the last part
        partSources.push_back({uint32_t(parts.size() - 1), resource});
    }
    void chooseHalves();
    void markWanted();
    bool markRunning();
    void commitHistories();
    Memory* memoryOf(Resource& resource);
    uint64_t heldVersion(Resource& resource);
    bool available(Resource& resource, uint64_t version);

    // Device objects (frame_graph_resources.cpp)
    void createResources();
    void placeScratch();
    void retireMemory(Slot& slot);
    void retireUnused();
    void zeroNewHistories(VkCommandBuffer commands);
    const gpu::Image& imageOf(const Resource& resource) const;
    const gpu::Buffer& bufferOf(const Resource& resource) const;

    // What passes bind (frame_graph_bindings.cpp)
    void checkBindings(const Pass& pass, const gpu::Pipeline& pipeline);
    VkDescriptorSet descriptorSet(const Pass& pass, const gpu::Pipeline& pipeline);
    VkDescriptorSet allocateSet(VkDescriptorSetLayout layout);
    void writeSet(VkDescriptorSet set, std::span<const gpu::ShaderBinding> bindings,
                  std::span<const Use* const> bound) const;

    // Two queues (frame_graph_queues.cpp)
    void markAsync();
    void beginBatches(VkCommandBuffer commands, const BeginBatch* begin);
    VkCommandBuffer beginBatch(gpu::Queue queue, int32_t after);
    VkCommandBuffer commandsFor(const Pass& pass);
    int32_t neededBatch(const Pass& pass, gpu::Queue queue);
    bool twoFamilies() const;
    void noteUse(Memory& memory, bool changes);
    void takeOwner(const Resource& resource, Memory& memory, const Access& access, bool discard);
    VkCommandBuffer joinQueues();
    void run(VkCommandBuffer commands);

    // Running and recording (frame_graph_execute.cpp, frame_graph_record.cpp)
    void synchronize(VkCommandBuffer commands, const Pass& pass, PassRecord* record);
    void synchronizeOutputs(VkCommandBuffer commands);
    void addBarrier(Resource& resource, const Access& access, bool discard, PassRecord* record);
    void flushBarriers(VkCommandBuffer commands);
    void recordPass(VkCommandBuffer commands, const Pass& pass);
    void recordCompute(VkCommandBuffer commands, const Pass& pass);
    void recordParts(VkCommandBuffer commands, const Pass& pass);
    void recordRaster(VkCommandBuffer commands, const Pass& pass);
    void recordDraws(VkCommandBuffer commands, const Pass& pass, VkDescriptorSet set, glm::uvec2 size);
    std::vector<Patch>* patchesOf(const Pass& pass);
    bool beginPatch(VkCommandBuffer commands, const Pass& pass, const Patch& patch);
    uint64_t patchKey(const Pass& pass, size_t first, size_t end) const;
    void recordTransfer(VkCommandBuffer commands, const Pass& pass);
    void recordCallback(VkCommandBuffer commands, const Pass& pass, VkDescriptorSet set, glm::uvec2 size);
    gpu::PipelineRequest requestFor(const Pass& pass, const RasterDraw* draw) const;
    void finishPass(const Pass& pass);
    void readTimes(VkCommandBuffer commands);
    void repeatPass(VkCommandBuffer commands, const Pass& pass);
    PassReport reportOf(const Pass& pass) const;
    PassReport finishReport(const Pass& pass, PassReport made);
    template <class Run>
    void runPasses(Run&& run);

    std::span<Use> usesOf(const Pass& pass) { return {uses.data() + pass.firstUse, pass.useCount}; }
    std::span<const Use> usesOf(const Pass& pass) const {
        return {uses.data() + pass.firstUse, pass.useCount};
    }
    std::span<const GroupPart> partsOf(const Pass& pass) const {
        return {parts.data() + pass.firstPart, pass.partCount};
    }
    std::span<const RasterDraw> drawsOf(const Pass& pass) const {
        return {draws.data() + pass.firstDraw, pass.drawCount};
    }
};

}  // namespace ag
