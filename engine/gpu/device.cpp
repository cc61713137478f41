#include "engine/gpu/device.h"

#include <array>

#include <time.h>

#include "engine/core/driver_cache.h"
#include "engine/core/program.h"
#include "engine/core/safe_file.h"
#include "engine/gpu/device_choice.h"
#include "engine/gpu/instance.h"
#include "engine/gpu/pipeline.h"
#include "engine/gpu/shader_files.h"

namespace ag::gpu {
namespace {

double processCpuMs() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) * 1e3 + double(t.tv_nsec) * 1e-6;
}

constexpr uint64_t kMostCacheBytes = uint64_t(1) << 30;

std::filesystem::path cacheFile() {
    const std::filesystem::path folder = cacheFolder();
    return folder.empty() ? folder : folder / "pipelines";
}

}  // namespace

struct Device::Impl {
    Functions vk;
    Instance instance;
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    DeviceChoice choice;
    VkDevice device = VK_NULL_HANDLE;
    // By gpu::Queue; without a second queue the second timeline is not used.
    std::array<VkQueue, kQueues> queues{};
    uint64_t ranOnce = 0;  // calls of runOnce()
    std::array<VkSemaphore, kQueues> timelines{};
    std::array<uint64_t, kQueues> submitted{};
    VkCommandPool oncePool = VK_NULL_HANDLE;
    VkPipelineCache pipelineCache = VK_NULL_HANDLE;
    std::unique_ptr<Context> context;
    std::unique_ptr<PipelineLibrary> pipelines;
    int messagesBefore;
    std::optional<WindowSurface> window;

    explicit Impl(const DeviceOptions& options)
        : messagesBefore(totalValidationMessages()), window(options.window) {}
    Status createDevice(const DeviceOptions& options);
    void createPipelineCache();
    void savePipelineCache() const;
    VkCommandBuffer recordOnce(const std::function<void(VkCommandBuffer)>& record);
};

Status Device::Impl::createDevice(const DeviceOptions& options) {
    if (window && window->make(instance.handle, &surface) != VK_SUCCESS)
        return Error{"cannot create a surface for the window"};
    auto chosen = chooseDevice(vk, instance.handle, surface, options);
    if (!chosen) return chosen.error();
    choice = std::move(*chosen);
    auto opened = openDevice(vk, choice, window.has_value());
    if (!opened) return opened.error();
    device = *opened;
    loadDeviceFunctions(vk, device);
    vk.GetDeviceQueue(device, choice.queueFamily, 0, &queues[0]);
    if (choice.asyncFamily) vk.GetDeviceQueue(device, *choice.asyncFamily, choice.asyncIndex, &queues[1]);
    createPipelineCache();
    context = std::make_unique<Context>(vk,
                                        ContextHandles{.instance = instance.handle,
                                                       .physical = choice.physical,
                                                       .device = device,
                                                       .queueFamily = choice.queueFamily,
                                                       .asyncFamily = choice.asyncFamily,
                                                       .pipelineCache = pipelineCache},
                                        choice.info, MemorySource{}, options.fault);
    pipelines = std::make_unique<PipelineLibrary>(*context, loadShader);
    const VkSemaphoreTypeCreateInfo type{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
                                         .semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE};
    const VkSemaphoreCreateInfo semaphore{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, .pNext = &type};
    for (VkSemaphore& timeline : timelines) {
        AG_VK(vk.CreateSemaphore(device, &semaphore, nullptr, &timeline));
        context->setDebugName(VK_OBJECT_TYPE_SEMAPHORE, timeline, "device.timeline");
    }
    context->setDebugName(VK_OBJECT_TYPE_QUEUE, queues[0], "device.queue");
    const VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                       .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                       .queueFamilyIndex = choice.queueFamily};
    AG_VK(vk.CreateCommandPool(device, &pool, nullptr, &oncePool));
    context->setDebugName(VK_OBJECT_TYPE_COMMAND_POOL, oncePool, "device.once");
    return Ok{};
}

void Device::Impl::createPipelineCache() {
    const auto data = readFile(cacheFile().string(), kMostCacheBytes);  // the driver checks the header itself
    VkPipelineCacheCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO,
                                   .initialDataSize = data ? data->size() : 0,
                                   .pInitialData = data ? data->data() : nullptr};
    AG_VK(vk.CreatePipelineCache(device, &info, nullptr, &pipelineCache));
    gpu::setDebugName(vk, device, VK_OBJECT_TYPE_PIPELINE_CACHE, pipelineCache, "device.pipelines");
}

void Device::Impl::savePipelineCache() const {
    size_t size = 0;
    vk.GetPipelineCacheData(device, pipelineCache, &size, nullptr);
    std::string data(size, 0);
    if (size == 0 || vk.GetPipelineCacheData(device, pipelineCache, &size, data.data()) != VK_SUCCESS) return;
    const std::string path = cacheFile().string();
    const auto before = readFile(path, kMostCacheBytes);
    if (path.empty() || (before && *before == data)) return;
    // A cache that cannot be written is only slower.
    if (makeFolderOf(path)) (void)bool(writeFileSafely(path, data));
}

Device::Device(const DeviceOptions& options) : impl_(std::make_unique<Impl>(options)) {}

Result<std::unique_ptr<Device>> Device::create(const DeviceOptions& options) {
    if (!hasRoom()) endProgram("out of memory: there is no room for a graphics driver");
    separateDriverCaches();
    std::unique_ptr<Device> device(new Device(options));
    Impl& d = *device->impl_;
    const std::vector<const char*> windows =
        d.window ? d.window->instanceExtensions : std::vector<const char*>{};
    if (Status made = openInstance(d.vk, windows, options.validation, d.instance); !made) return made.error();
    if (Status made = d.createDevice(options); !made) return made.error();
    return device;
}

Device::~Device() {
    Impl& d = *impl_;
    if (d.context) {
        waitIdle();
        d.pipelines.reset();
        d.savePipelineCache();
        d.vk.DestroyPipelineCache(d.device, d.pipelineCache, nullptr);
        d.vk.DestroyCommandPool(d.device, d.oncePool, nullptr);
        for (VkSemaphore timeline : d.timelines)
            d.vk.DestroySemaphore(d.device, timeline, nullptr);
        d.context.reset();
    }
    if (d.device) d.vk.DestroyDevice(d.device, nullptr);
    if (d.surface) d.vk.DestroySurfaceKHR(d.instance.handle, d.surface, nullptr);
    closeInstance(d.vk, d.instance);
}

Context& Device::context() {
    return *impl_->context;
}
const Context& Device::asContext() const {
    return *impl_->context;
}
PipelineLibrary& Device::pipelines() {
    return *impl_->pipelines;
}
VkQueue Device::queue() const {
    return impl_->queues[0];
}
VkSurfaceKHR Device::surface() const {
    return impl_->surface;
}
Status Device::renewSurface() {
    impl_->vk.DestroySurfaceKHR(impl_->instance.handle, impl_->surface, nullptr);
    impl_->surface = VK_NULL_HANDLE;
    if (impl_->window->make(impl_->instance.handle, &impl_->surface) != VK_SUCCESS)
        return Error{"the window's surface was lost, and another one cannot be made"};
    return Ok{};
}

namespace {

VkSemaphoreSubmitInfo atAllCommands(VkSemaphore semaphore, uint64_t value = 0) {
    return {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
            .semaphore = semaphore,
            .value = value,
            .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
}

}  // namespace

uint64_t Device::submit(const Submission& work) {
    const size_t own = size_t(work.queue), other = size_t(otherQueue(work.queue));
    const VkCommandBufferSubmitInfo buffer{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                           .commandBuffer = work.commands};
    std::array<VkSemaphoreSubmitInfo, 2> waits, signals;
    uint32_t waitCount = 0, signalCount = 0;
    if (work.waitBinary) waits[waitCount++] = atAllCommands(work.waitBinary);
    if (work.after) waits[waitCount++] = atAllCommands(impl_->timelines[other], work.after);
    const uint64_t value = ++impl_->submitted[own];
    signals[signalCount++] = atAllCommands(impl_->timelines[own], value);
    if (work.signalBinary) signals[signalCount++] = atAllCommands(work.signalBinary);
    const VkSubmitInfo2 info{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                             .waitSemaphoreInfoCount = waitCount,
                             .pWaitSemaphoreInfos = waits.data(),
                             .commandBufferInfoCount = work.commands ? 1u : 0u,
                             .pCommandBufferInfos = &buffer,
                             .signalSemaphoreInfoCount = signalCount,
                             .pSignalSemaphoreInfos = signals.data()};
    context().record(submittedValue() + 1);
    const bool lost = context().strikes(Fault::kSubmit);
    checkVk(
        lost ? VK_ERROR_DEVICE_LOST : impl_->vk.QueueSubmit2(impl_->queues[own], 1, &info, VK_NULL_HANDLE),
        "vkQueueSubmit2");
    return value;
}

uint64_t Device::completedValue() const {
    uint64_t value = 0;
    AG_VK(impl_->vk.GetSemaphoreCounterValue(impl_->device, impl_->timelines[0], &value));
    return value;
}

uint64_t Device::submittedValue() const {
    return impl_->submitted[0];
}

void Device::waitFor(uint64_t timelineValue) {
    const VkSemaphoreWaitInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO,
                                   .semaphoreCount = 1,
                                   .pSemaphores = &impl_->timelines[0],
                                   .pValues = &timelineValue};
    AG_VK(impl_->vk.WaitSemaphores(impl_->device, &info, UINT64_MAX));
}

void Device::waitIdle() {
    AG_VK(impl_->vk.DeviceWaitIdle(impl_->device));
}

void Device::collect() {
    context().finish(completedValue());
}

VkCommandBuffer Device::Impl::recordOnce(const std::function<void(VkCommandBuffer)>& record) {
    const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                           .commandPool = oncePool,
                                           .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                           .commandBufferCount = 1};
    VkCommandBuffer commands = VK_NULL_HANDLE;
    AG_VK(vk.AllocateCommandBuffers(device, &info, &commands));
    context->setDebugName(VK_OBJECT_TYPE_COMMAND_BUFFER, commands, "device.once");
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    AG_VK(vk.BeginCommandBuffer(commands, &begin));
    record(commands);
    // What was written becomes visible to the host: waiting alone does not make it so.
    const VkMemoryBarrier2 toHost{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                  .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                  .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
                                  .dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT,
                                  .dstAccessMask = VK_ACCESS_2_HOST_READ_BIT};
    const VkDependencyInfo dependency{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &toHost};
    vk.CmdPipelineBarrier2(commands, &dependency);
    AG_VK(vk.EndCommandBuffer(commands));
    return commands;
}

void Device::runOnce(const std::function<void(VkCommandBuffer)>& record) {
    ++impl_->ranOnce;
    const VkCommandBuffer commands = impl_->recordOnce(record);
    submit(commands);
    // Not the timeline: synchronization validation follows the queue's own wait only.
    AG_VK(impl_->vk.QueueWaitIdle(impl_->queues[0]));
    impl_->vk.FreeCommandBuffers(impl_->device, impl_->oncePool, 1, &commands);
}

uint64_t Device::transfersWaitedFor() const {
    return impl_->ranOnce;
}

double Device::timeOnCpu(const std::function<void(VkCommandBuffer)>& record) {
    const VkCommandBuffer commands = impl_->recordOnce(record);
    const double before = processCpuMs();
    waitFor(submit(commands));
    const double spent = processCpuMs() - before;
    impl_->vk.FreeCommandBuffers(impl_->device, impl_->oncePool, 1, &commands);
    return spent;
}

std::optional<ClockPair> Device::readClocks() const {
    if (!info().calibrated) return std::nullopt;
    const VkCalibratedTimestampInfoEXT clocks[] = {
        {.sType = VK_STRUCTURE_TYPE_CALIBRATED_TIMESTAMP_INFO_EXT, .timeDomain = VK_TIME_DOMAIN_DEVICE_EXT},
        {.sType = VK_STRUCTURE_TYPE_CALIBRATED_TIMESTAMP_INFO_EXT,
         .timeDomain = VK_TIME_DOMAIN_CLOCK_MONOTONIC_EXT}};
    uint64_t times[2] = {0, 0}, deviation = 0;
    AG_VK(impl_->vk.GetCalibratedTimestampsEXT(impl_->device, 2, clocks, times, &deviation));
    return ClockPair{times[0], times[1]};
}

int Device::validationMessageCount() const {
    return totalValidationMessages() - impl_->messagesBefore;
}

}  // namespace ag::gpu
