#include "engine/renderer/renderer.h"

#include <chrono>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>

#include "engine/gpu/device_limits.h"
#include "engine/gpu/transfer.h"
#include "shaders/exposure/exposure_io.h"

namespace ag::render {
namespace {

uint64_t steadyNs() {
    return uint64_t(std::chrono::duration_cast<std::chrono::nanoseconds>(
                        std::chrono::steady_clock::now().time_since_epoch())
                        .count());
}

// Not where joints bend what rays would meet as it was modelled.
bool canCastTexelRays(const gpu::DeviceInfo& info, const RenderSettings& s, const RenderScene& scene) {
    return gi::canCastRays(info, s.bounce) && scene.skinnedMeshes.empty();
}

}  // namespace

Renderer::Renderer(gpu::Device& device, uint32_t threads)
    : device_(device), jobs_(threads), scene_(device), graph_(&device.context(), &device.pipelines()) {
    const uint32_t families[] = {device.queueFamily(),
                                 device.context().asyncFamily().value_or(device.queueFamily())};
    for (Slot& slot : slots_)
        for (size_t queue = 0; queue < gpu::kQueues; ++queue) {
            const VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                               .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                               .queueFamilyIndex = families[queue]};
            AG_VK(device.vk().CreateCommandPool(device.handle(), &pool, nullptr, &slot.commands[queue].pool));
            device.context().setDebugName(VK_OBJECT_TYPE_COMMAND_POOL, slot.commands[queue].pool, "frame");
        }
}

Renderer::~Renderer() {
    device_.waitIdle();
    for (Slot& slot : slots_)
        for (Commands& commands : slot.commands)
            device_.vk().DestroyCommandPool(device_.handle(), commands.pool, nullptr);
}

VkCommandBuffer Renderer::beginCommands(Commands& commands) {
    if (commands.used == commands.buffers.size()) {
        const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                               .commandPool = commands.pool,
                                               .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                               .commandBufferCount = 1};
        VkCommandBuffer& buffer = commands.buffers.emplace_back(VK_NULL_HANDLE);
        AG_VK(device_.vk().AllocateCommandBuffers(device_.handle(), &info, &buffer));
        device_.context().setDebugName(VK_OBJECT_TYPE_COMMAND_BUFFER, buffer, "frame");
    }
    const VkCommandBuffer buffer = commands.buffers[commands.used++];
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    AG_VK(device_.vk().BeginCommandBuffer(buffer, &begin));
    return buffer;
}

void Renderer::resetCommands(Slot& slot) {
    for (Commands& commands : slot.commands) {
        AG_VK(device_.vk().ResetCommandPool(device_.handle(), commands.pool, 0));
        commands.used = 0;
    }
}

void Renderer::load(const GeometryArrays& geometry) {
    scene_.load(geometry);
    if (units_ != RenderUnits{}) ++unitsGeneration_;
    units_ = {};
    extent_ = 0;
    startAnew();
}

void Renderer::loadMaterials(const GeometryArrays& geometry) {
    waitIdle();
    scene_.changeMaterials(geometry, units_);
}

void Renderer::startAnew() {
    waitIdle();
    graph_.reset();
    history_ = {};
}

const RenderScene& Renderer::inOwnUnits(const RenderScene& scene) {
    const RenderUnits units = chooseUnits(scene, scene_.strongestEmission(scene), units_);
    if (units != units_) {
        units_ = units;
        extent_ = 0;
        ++unitsGeneration_;
        waitIdle();
        scene_.useUnits(*scene.geometry, units);
        startAnew();
    }
    if (unitsGeneration_ == 0) return scene;
    inUnits(scene, units_, unitsGeneration_, converted_);
    return converted_;
}

void Renderer::render(const RenderScene& given, glm::uvec2 size, const RenderSettings& settings,
                      const FrameGraphOptions& options, Finish finish, const Presentation& presentation) {
    const uint32_t index = uint32_t(frame_++ % kFramesInFlight);
    Slot& slot = slots_[index];
    moments_.begin = steadyNs();
    device_.waitFor(slot.submitted);
    device_.collect();
    resetCommands(slot);
    moments_.waited = steadyNs();
    const RenderScene& scene = inOwnUnits(given);
    graph_.beginFrame(options);
    scene_.beginFrame(scene, jobs_);
    RenderSettings asked = settings;
    fitToDevice(device_.info().limits, asked);
    if (!canCastTexelRays(device_.info(), asked, scene)) gi::turnRaysOff(asked.bounce);
    asked.bounce.ismAtlas.keepMaps = settings.bounce.ismAtlas.keepMaps && options.skip;
    asked.composite.exposure += std::log2(units_.light);
    const PixelGrid grid = choosePixels(asked.antialiasing, size, scene, history_.picture.next(scene, asked),
                                        history_.antialiasing);
    SceneView view =
        scene_.import(graph_, scene, grid, tracedBy(asked, given), asked.bounce.valShading.glossy);
    view.units = units_;
    view.extent = extent_ = gi::steadyExtent(scene.bounds, extent_);
    // Anisotropic filtering without hardware takes the pass three times as long.
    view.sharp = history_.standstill.next(view) || !device_.info().isCpu;
    const RenderFrame frame = addFrame(graph_, view, asked, history_);
    finish(graph_, view, frame);
    moments_.declared = steadyNs();

    const VkCommandBuffer first = beginCommands(slot.commands[0]);
    using Previous = SceneGpu::Previous;
    const Previous previous = graph_.isRead(view.previousInstances) ? Previous::kKept : Previous::kUnread;
    scene_.upload(first, graph_, view, previous, index);
    recordFrame(slot, options, first);
    presentation.record(batches_.back().commands);
    for (const QueueBatch& batch : batches_)
        AG_VK(device_.vk().EndCommandBuffer(batch.commands));
    moments_.recorded = steadyNs();
    submitBatches(slot, presentation);
    moments_.submitted = steadyNs();
    if (jobs_.threadCount() == 1) device_.waitFor(slot.submitted);
}

void Renderer::recordFrame(Slot& slot, const FrameGraphOptions& options, VkCommandBuffer first) {
    if (options.timing != TimingMode::kProcessCpu) {
        const auto more = graph_.execute(
            first, [&](gpu::Queue queue) { return beginCommands(slot.commands[size_t(queue)]); });
        batches_.assign(more.begin(), more.end());
        return;
    }
    // The graph submits by itself, so the uploads must be on their way before it.
    AG_VK(device_.vk().EndCommandBuffer(first));
    device_.waitFor(device_.submit(first));
    resetCommands(slot);
    graph_.executeAlone([&](const auto& record) { return device_.timeOnCpu(record); });
    batches_.assign(1, {gpu::Queue::kMain, beginCommands(slot.commands[0])});
}

// The window's image is drawn in the last batch.
void Renderer::submitBatches(Slot& slot, const Presentation& presentation) {
    batchesSubmitted_.clear();
    for (const QueueBatch& batch : batches_) {
        gpu::Submission work{.commands = batch.commands, .queue = batch.queue};
        if (batch.after >= 0) work.after = batchesSubmitted_[size_t(batch.after)];
        if (&batch == &batches_.back()) {
            work.waitBinary = presentation.wait;
            work.signalBinary = presentation.signal;
        }
        batchesSubmitted_.push_back(device_.submit(work));
    }
    slot.submitted = batchesSubmitted_.back();
}

float readExposure(Renderer& renderer, BufferHandle handle) {
    io::Exposure exposure{};
    renderer.waitIdle();
    gpu::downloadBuffer(renderer.device(), renderer.graph().physical(handle),
                        std::as_writable_bytes(std::span(&exposure, 1)));
    return exposure.stops - std::log2(renderer.units().light);
}

Image readImage(Renderer& renderer, ImageHandle handle) {
    const gpu::Image& image = renderer.graph().physical(handle);
    const glm::uvec2 size = image.desc().size;
    const VkFormat format = image.desc().format;
    std::vector<std::byte> bytes(size_t(size.x) * size.y * gpu::texelSizeBytes(format));
    renderer.waitIdle();
    gpu::downloadImage(renderer.device(), image, renderer.graph().layoutAfterFrame(handle), bytes);
    Image out(int(size.x), int(size.y));
    for (size_t i = 0; i < out.pixels.size(); ++i) {
        if (format == VK_FORMAT_R32G32B32A32_SFLOAT) {
            std::memcpy(&out.pixels[i], bytes.data() + i * 16, 12);
        } else if (format == VK_FORMAT_R16G16B16A16_SFLOAT) {
            uint64_t packed;
            std::memcpy(&packed, bytes.data() + i * 8, 8);
            out.pixels[i] = glm::vec3(glm::unpackHalf4x16(packed));
        } else if (format == VK_FORMAT_R8G8B8A8_UNORM) {
            uint32_t packed;
            std::memcpy(&packed, bytes.data() + i * 4, 4);
            out.pixels[i] = glm::vec3(glm::unpackUnorm4x8(packed));
        } else {
            float value;
            std::memcpy(&value, bytes.data() + i * 4, 4);
            out.pixels[i] = glm::vec3(value);
        }
    }
    return out;
}

Image renderLayer(Renderer& renderer, const RenderScene& scene, glm::uvec2 size,
                  const RenderSettings& settings, Layer layer, uint32_t frames) {
    ImageHandle shown;
    const RenderSettings alone = settingsOf(layer, settings);
    for (uint32_t i = 0; i < std::max(frames, 1u); ++i)
        renderer.render(scene, size, alone, {.timing = TimingMode::kOff},
                        [&](GraphScope scope, const SceneView& view, const RenderFrame& frame) {
                            shown = addLayer(scope, view, frame, layer);
                            if (shown) scope.output(shown);
                        });
    return shown ? readImage(renderer, shown) : Image(int(size.x), int(size.y));
}

}  // namespace ag::render
