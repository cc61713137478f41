#include "engine/renderer/renderer.h"

#include <chrono>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>

#include "engine/gpu/shader_files.h"
#include "engine/gpu/transfer.h"

namespace ag::render {
namespace {

uint64_t steadyNs() {
    return uint64_t(std::chrono::duration_cast<std::chrono::nanoseconds>(
                        std::chrono::steady_clock::now().time_since_epoch())
                        .count());
}

}  // namespace

Renderer::Renderer(gpu::Device& device, uint32_t threads)
    : device_(device),
      jobs_(threads),
      pipelines_(device, gpu::loadShader),
      scene_(device),
      graph_(&device.context(), &pipelines_) {
    for (Slot& slot : slots_) {
        const VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                           .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                           .queueFamilyIndex = device.queueFamily()};
        AG_VK(device.vk().CreateCommandPool(device.handle(), &pool, nullptr, &slot.pool));
        device.context().setDebugName(VK_OBJECT_TYPE_COMMAND_POOL, slot.pool, "frame");
        const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                               .commandPool = slot.pool,
                                               .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                               .commandBufferCount = 1};
        AG_VK(device.vk().AllocateCommandBuffers(device.handle(), &info, &slot.commands));
        device.context().setDebugName(VK_OBJECT_TYPE_COMMAND_BUFFER, slot.commands, "frame");
    }
}

Renderer::~Renderer() {
    device_.waitIdle();
    for (Slot& slot : slots_)
        device_.vk().DestroyCommandPool(device_.handle(), slot.pool, nullptr);
}

void Renderer::load(const GeometryArrays& geometry) {
    scene_.load(geometry);
    if (units_ != RenderUnits{}) ++unitsGeneration_;
    units_ = {};
    extent_ = 0;
    startAnew();
}

// Without anything of the frames before.
void Renderer::startAnew() {
    graph_.reset();
    history_ = {};
}

const RenderScene& Renderer::inOwnUnits(const RenderScene& scene) {
    const RenderUnits units = chooseUnits(scene, scene_.strongestEmission(), units_);
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
    AG_VK(device_.vk().ResetCommandPool(device_.handle(), slot.pool, 0));

    moments_.waited = steadyNs();
    const RenderScene& scene = inOwnUnits(given);
    graph_.beginFrame(options);
    scene_.beginFrame(scene, jobs_);
    SceneView view = scene_.import(graph_, scene, size);
    view.units = units_;
    view.extent = extent_ = gi::steadyExtent(scene.bounds, extent_);
    RenderSettings asked = settings;
    fitToDevice(device_.info().limits, asked);
    asked.bounce.ismAtlas.keepMaps = settings.bounce.ismAtlas.keepMaps && options.skip;
    asked.composite.exposure += std::log2(units_.light);
    const RenderFrame frame = addFrame(graph_, view, asked, history_);
    finish(graph_, view, frame);
    moments_.declared = steadyNs();

    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    AG_VK(device_.vk().BeginCommandBuffer(slot.commands, &begin));
    using Previous = SceneGpu::Previous;
    const Previous previous = graph_.isRead(view.previousInstances) ? Previous::kKept : Previous::kUnread;
    scene_.upload(slot.commands, graph_, view, previous, index);
    if (options.timing == TimingMode::kProcessCpu) {
        // The graph submits by itself, so the uploads must be on their way before it.
        AG_VK(device_.vk().EndCommandBuffer(slot.commands));
        device_.waitFor(device_.submit(slot.commands));
        AG_VK(device_.vk().ResetCommandPool(device_.handle(), slot.pool, 0));
        graph_.executeAlone([&](const auto& record) { return device_.timeOnCpu(record); });
        AG_VK(device_.vk().BeginCommandBuffer(slot.commands, &begin));
    } else {
        graph_.execute(slot.commands);
    }
    presentation.record(slot.commands);
    AG_VK(device_.vk().EndCommandBuffer(slot.commands));
    moments_.recorded = steadyNs();
    slot.submitted = device_.submit(slot.commands, presentation.wait, presentation.signal);
    moments_.submitted = steadyNs();
    if (jobs_.threadCount() == 1) device_.waitFor(slot.submitted);
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
    for (uint32_t i = 0; i < std::max(frames, 1u); ++i)
        renderer.render(scene, size, settings, {.timing = TimingMode::kOff},
                        [&](GraphScope scope, const SceneView& view, const RenderFrame& frame) {
                            shown = addLayer(scope, view, frame, layer);
                            if (shown) scope.output(shown);
                        });
    return shown ? readImage(renderer, shown) : Image(int(size.x), int(size.y));
}

}  // namespace ag::render
