// Runs frames on a device: owns the scene's device memory, the frame graph and the histories, keeps two
// frames in flight. Windowed and headless programs and the tests all render through it.
#pragma once

#include <array>

#include "engine/core/function_ref.h"
#include "engine/core/image.h"
#include "engine/gpu/device.h"
#include "engine/renderer/debug_view.h"

namespace ag::render {

// How a frame comes to be shown; headless: not.
struct Presentation {
    static constexpr auto kNothing = [](VkCommandBuffer) {};
    FunctionRef<void(VkCommandBuffer)> record = kNothing;  // after the frame, with its command buffer
    // Of a swapchain's image: it may be written, it is written.
    VkSemaphore wait = VK_NULL_HANDLE, signal = VK_NULL_HANDLE;
};

// When the CPU did what for a frame, on std::chrono::steady_clock, ns.
struct FrameMoments {
    uint64_t begin = 0;      // then it waits for the device to be done with the frame before last
    uint64_t waited = 0;     // then it declares the passes
    uint64_t declared = 0;   // then it plans and records them
    uint64_t recorded = 0;   // then it submits them
    uint64_t submitted = 0;  // (a software device may have run some of them by now)
};

class Renderer {
  public:
    // `threads` 1: views are culled in order on the caller, and render() waits for the device; 0: as many as
    // the machine has, while the device works on the frame before.
    explicit Renderer(gpu::Device& device, uint32_t threads = 0);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    // Blocking: a scene just loaded; histories start anew.
    void load(const GeometryArrays& geometry);
    // Blocking: of what was loaded only materials' factors changed, and its version. Histories go on.
    void loadMaterials(const GeometryArrays& geometry);
    // Nothing of the frames before is known any more.
    void startAnew();

    // One frame: `finish` is called with the declared frame before it runs, to add passes and name outputs.
    using Finish = FunctionRef<void(GraphScope, const SceneView&, const RenderFrame&)>;
    void render(const RenderScene& scene, glm::uvec2 size, const RenderSettings& settings,
                const FrameGraphOptions& options, Finish finish, const Presentation& presentation = {});
    void waitIdle() { device_.waitIdle(); }

    // Of the scene's probes, kFramesInFlight frames ago.
    const gi::ProbeReadings& probeReadings() const { return history_.bounce.probes.readings; }
    FrameGraph& graph() { return graph_; }
    SceneGpu& scene() { return scene_; }
    gpu::Device& device() { return device_; }
    // Of everything in the frame; the layers of debug_view and the probes' readings are in metres and watts.
    RenderUnits units() const { return units_; }
    // Of the times that the graph reports now: what may be late was (see refresh.h).
    bool timesArePartial() const { return history_.bounce.refresh.sincePatient <= kFramesInFlight; }
    const FrameMoments& moments() const { return moments_; }  // of the frame last rendered
    size_t submissions() const { return batches_.size(); }    // the same: 1 where all went to one queue
    uint64_t deviceBytes() const { return graph_.transientBytes() + scene_.deviceBytes(); }

  private:
    const RenderScene& inOwnUnits(const RenderScene& scene);
    // Command buffers of a queue, used again every kFramesInFlight frames.
    struct Commands {
        VkCommandPool pool = VK_NULL_HANDLE;
        std::vector<VkCommandBuffer> buffers;
        size_t used = 0;
    };
    struct Slot {
        std::array<Commands, gpu::kQueues> commands;  // by gpu::Queue
        uint64_t submitted = 0;
    };
    VkCommandBuffer beginCommands(Commands& commands);
    void resetCommands(Slot& slot);
    void recordFrame(Slot& slot, const FrameGraphOptions& options, VkCommandBuffer first);
    void submitBatches(Slot& slot, const Presentation& presentation);
    gpu::Device& device_;
    JobRunner jobs_;
    SceneGpu scene_;
    FrameGraph graph_;
    RenderHistory history_;
    RenderUnits units_;
    float extent_ = 0;  // in those units
    uint64_t unitsGeneration_ = 0;
    RenderScene converted_;  // while the units are not metres and watts
    std::array<Slot, kFramesInFlight> slots_;
    std::vector<QueueBatch> batches_;         // of the frame being recorded
    std::vector<uint64_t> batchesSubmitted_;  // scratch: their values
    uint64_t frame_ = 0;
    FrameMoments moments_;
};

// Renders `frames` frames of a still scene, untimed, and reads back a layer (black where the frame has none).
Image renderLayer(Renderer& renderer, const RenderScene& scene, glm::uvec2 size,
                  const RenderSettings& settings, Layer layer, uint32_t frames);
// An image the graph left as its output, as floats; rgba8, rgba16f, rgba32f and r32f.
Image readImage(Renderer& renderer, ImageHandle image);
// Of a graph output of addExposure: stops by which radiance in W/(m² sr) is brightened.
float readExposure(Renderer& renderer, BufferHandle exposure);

}  // namespace ag::render
